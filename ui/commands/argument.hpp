#pragma once
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace nextview {

struct SessionSnapshot;

/// A value that a command takes.
struct Argument {
  enum class Kind { number, whole, text, choice, file };
  using Choices = std::function<std::vector<std::string>(const SessionSnapshot&)>;
  std::string name;  ///< "candidate"
  Kind kind = Kind::text;
  std::string help;  ///< what it is, with its unit
  double low = -1e9, high = 1e9;
  Choices choices = {};      ///< all there are, or suggestions
  bool optional = false;     ///< this and all that follow it
  std::string command = {};  ///< that takes it; for messages

  /// The value that a text says, as a script or the user writes it.
  /// @throws std::invalid_argument in one line: what the value must be.
  template <class Value>
  void read(const std::string& text, Value& value) const;
  template <class Value>
  void read(const std::string& text, std::optional<Value>& value) const;
  /// Adds the text that says a value. False if there is none.
  template <class Value>
  bool write(const Value& value, std::vector<std::string>& texts) const;
  template <class Value>
  bool write(const std::optional<Value>& value, std::vector<std::string>& texts) const;
  /// @throws std::invalid_argument as read()
  template <class Value>
  void check(const Value& value) const;

 private:
  double number_of(const std::string& text) const;
  std::size_t choice_of(const std::string& text) const;
  const std::string& checked_text(const std::string& text) const;
  std::string name_of(std::size_t choice) const;
  void check_number(double value) const;
  static std::string text_of(double value);
};

/// An argument and the type of its values: a number, a text, or an enumeration in the order of the choices.
template <class Value>
struct ArgumentOf : Argument {};

namespace argument {

ArgumentOf<double> number(std::string name, std::string help, double low, double high);
ArgumentOf<std::string> text(std::string name, std::string help, Argument::Choices suggestions = {});
ArgumentOf<std::string> file(std::string name, std::string help, Argument::Choices suggestions = {});
/// One of a list, by its name.
ArgumentOf<std::string> name(std::string name, std::string help, Argument::Choices names);
Argument::Choices fixed(std::vector<std::string> names);

template <class Value = std::size_t>
ArgumentOf<Value> whole(std::string name, std::string help, double low, double high,
                        Argument::Choices suggestions = {}) {
  return {{std::move(name), Argument::Kind::whole, std::move(help), low, high, std::move(suggestions)}};
}

/// One of an enumeration; `names` are in its order.
template <class Enum>
ArgumentOf<Enum> choice(std::string name, std::string help, std::vector<std::string> names) {
  return {{std::move(name), Argument::Kind::choice, std::move(help), 0, 0, fixed(std::move(names))}};
}

template <class Value>
ArgumentOf<std::optional<Value>> optional(ArgumentOf<Value> argument) {
  argument.optional = true;
  return {std::move(static_cast<Argument&>(argument))};
}

}  // namespace argument

template <class Value>
void Argument::read(const std::string& text, Value& value) const {
  if constexpr (std::is_enum_v<Value>) {
    value = static_cast<Value>(choice_of(text));
  } else if constexpr (std::is_arithmetic_v<Value>) {
    value = static_cast<Value>(number_of(text));
  } else {
    value = checked_text(text);
  }
}

template <class Value>
void Argument::read(const std::string& text, std::optional<Value>& value) const {
  read(text, value.emplace());
}

template <class Value>
bool Argument::write(const Value& value, std::vector<std::string>& texts) const {
  if constexpr (std::is_enum_v<Value>) {
    texts.push_back(name_of(static_cast<std::size_t>(value)));
  } else if constexpr (std::is_integral_v<Value>) {
    texts.push_back(std::to_string(value));
  } else if constexpr (std::is_arithmetic_v<Value>) {
    texts.push_back(text_of(value));
  } else {
    texts.push_back(value);
  }
  return true;
}

template <class Value>
bool Argument::write(const std::optional<Value>& value, std::vector<std::string>& texts) const {
  return value && write(*value, texts);
}

template <class Value>
void Argument::check(const Value& value) const {
  if constexpr (std::is_arithmetic_v<Value>) check_number(static_cast<double>(value));
  if constexpr (std::is_same_v<Value, std::string>) checked_text(value);
  if constexpr (requires { value.has_value(); })
    if (value) check(*value);
}

}  // namespace nextview
