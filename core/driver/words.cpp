#include "core/driver/words.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace nextview {
namespace {

constexpr std::string_view blanks = " \t\n\r", escaped_in_double_quotes = "$`\"\\\n";

/// Reads one character after another, as the quotes around it have it.
class Splitter {
 public:
  explicit Splitter(std::string_view text) : text_(text) {}

  std::vector<std::string> split() {
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (blanks.find(c) != blanks.npos)
        end_word();
      else if (c == '\'')
        single_quoted();
      else if (c == '"')
        double_quoted();
      else if (c == '\\')
        escaped();
      else
        add(c);
    }
    end_word();
    return std::move(words_);
  }

 private:
  void add(char c) { begin_word() += c; }
  /// Quotes begin a word even if there is nothing in them.
  std::string& begin_word() { return word_ ? *word_ : word_.emplace(); }
  void end_word() {
    if (word_) words_.push_back(*std::move(word_));
    word_.reset();
  }

  void single_quoted() {
    const std::size_t end = text_.find('\'', at_);
    if (end == text_.npos) throw std::invalid_argument("a single quote (') is not closed");
    begin_word() += text_.substr(at_, end - at_);
    at_ = end + 1;
  }

  void double_quoted() {
    begin_word();
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (c == '"') return;
      const bool escapes = c == '\\' && at_ < text_.size() && escaped_in_double_quotes.find(text_[at_]) != text_.npos;
      if (!escapes)
        add(c);
      else
        escaped();
    }
    throw std::invalid_argument("a double quote (\") is not closed");
  }

  void escaped() {
    if (at_ == text_.size()) throw std::invalid_argument("it ends in a backslash, which stands before something");
    if (const char c = text_[at_++]; c != '\n') add(c);  // a line that goes on
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::optional<std::string> word_;
  std::vector<std::string> words_;
};

}  // namespace

std::vector<std::string> shell_words(std::string_view text) {
  std::vector<std::string> words = Splitter(text).split();
  if (words.empty() || words.front().empty()) throw std::invalid_argument("it names no program");
  return words;
}

std::string program_named(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 9> interpreters = {"env",  "sh",   "bash", "dash",  "zsh",
                                                            "perl", "ruby", "node", "python"};
  const auto interprets = [&](const std::string& word) {
    std::string name = std::filesystem::path(word).filename().string();
    name.erase(name.find_last_not_of("0123456789.") + 1);  // python3.11
    return std::ranges::find(interpreters, name) != interpreters.end();
  };
  const auto is_option = [](const std::string& word) { return word.starts_with('-'); };
  std::size_t at = 0;
  while (at + 1 < words.size() && (interprets(words[at]) || is_option(words[at]))) {
    if (words[at] == "-c" || words[at] == "-e") return words.front();  // what follows is the script itself
    ++at;
  }
  return interprets(words[at]) || is_option(words[at]) ? words.front() : words[at];
}

}  // namespace nextview
