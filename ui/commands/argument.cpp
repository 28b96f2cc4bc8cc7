#include "ui/commands/argument.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "core/setting/setting.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {
namespace {

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::invalid_argument wrong(const Argument& argument, const std::string& wanted, const std::string& text) {
  return std::invalid_argument(
      fmt::format("{}: {} must be {}, not '{}'", argument.command, upper_case(argument.name), wanted, text));
}

bool within(const Argument& a, double value) {
  return value >= a.low && value <= a.high && (a.kind != Argument::Kind::whole || value == std::floor(value));
}

std::string wanted_number(const Argument& a) {
  const bool whole = a.kind == Argument::Kind::whole;
  return fmt::format("a {}number from {:g} to {:g}", whole ? "whole " : "", a.low, a.high);
}

}  // namespace

std::string Argument::text_of(double value) { return fmt::format("{}", value); }

double Argument::number_of(const std::string& text) const {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !within(*this, value))
    throw wrong(*this, wanted_number(*this), text);
  return value;
}

void Argument::check_number(double value) const {
  if (!within(*this, value)) throw wrong(*this, wanted_number(*this), text_of(value));
}

std::size_t Argument::choice_of(const std::string& text) const {
  const auto names = choices({});
  const auto found = std::find(names.begin(), names.end(), text);
  constexpr std::size_t most_listed = 30;
  if (found == names.end() && names.size() > most_listed)
    throw std::invalid_argument(
        fmt::format("{}: there is no {} '{}'{}", command, upper_case(name), text, did_you_mean(text, names)));
  if (found == names.end()) throw wrong(*this, fmt::format("one of {}", fmt::join(names, ", ")), text);
  return static_cast<std::size_t>(found - names.begin());
}

std::string Argument::name_of(std::size_t choice) const { return choices({}).at(choice); }

const std::string& Argument::checked_text(const std::string& text) const {
  if (kind == Kind::choice) choice_of(text);
  if (kind == Kind::file && text.empty()) throw wrong(*this, "given", text);
  return text;
}

namespace argument {

Argument::Choices fixed(std::vector<std::string> names) {
  return [names = std::move(names)](const SessionSnapshot&) { return names; };
}

ArgumentOf<double> number(std::string name, std::string help, double low, double high) {
  return {{std::move(name), Argument::Kind::number, std::move(help), low, high}};
}

ArgumentOf<std::string> text(std::string name, std::string help, Argument::Choices suggestions) {
  return {{std::move(name), Argument::Kind::text, std::move(help), 0, 0, std::move(suggestions)}};
}

ArgumentOf<std::string> file(std::string name, std::string help, Argument::Choices suggestions) {
  return {{std::move(name), Argument::Kind::file, std::move(help), 0, 0, std::move(suggestions)}};
}

ArgumentOf<std::string> name(std::string name, std::string help, Argument::Choices names) {
  return {{std::move(name), Argument::Kind::choice, std::move(help), 0, 0, std::move(names)}};
}

}  // namespace argument
}  // namespace nextview
