#include "core/journal/branches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace nextview {
namespace {

constexpr std::size_t max_name = 60;  ///< [bytes] more does not fit where it is shown

void require_free(const Branches& branches, const std::string& name) {
  const bool printable = std::ranges::none_of(name, [](unsigned char c) { return c < ' ' || c == 127; });
  if (name.empty() || name.size() > max_name || !printable || name.front() == ' ' || name.back() == ' ')
    throw std::invalid_argument(fmt::format("a branch's name is a line of 1 to {} characters", max_name));
  if (branches.has(name)) throw std::invalid_argument(fmt::format("there is a branch '{}' already", name));
}

}  // namespace

void Branches::add(std::string name, std::uint32_t tip) {
  all.push_back({std::move(name), tip, next_id++});
  on = all.size() - 1;
}

bool Branches::add_step(std::uint32_t number, std::uint32_t after) {
  const bool is_new = current().tip != after;
  if (is_new) {
    add(free_name(), after);
  }
  current().tip = number;
  return is_new;
}

void Branches::begin(const std::string& name, std::uint32_t at) {
  require_free(*this, name);
  add(name, at);
}

void Branches::rename(std::string_view name, const std::string& to) {
  const std::size_t branch = find(name);
  if (name != to) require_free(*this, to);
  all[branch].name = to;
}

void Branches::remove(std::string_view name) {
  const std::size_t branch = find(name);
  if (branch == on)
    throw std::invalid_argument(fmt::format("the scan is on '{}': go to another branch first", all[branch].name));
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(branch));
  on -= on > branch;
}

std::size_t Branches::find(std::string_view name) const {
  const auto found = std::ranges::find(all, name, &Branch::name);
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  std::vector<std::string> names;
  for (const Branch& branch : all) names.push_back(branch.name);
  throw std::invalid_argument(fmt::format("there is no branch '{}'; there are {}", name, fmt::join(names, ", ")));
}

bool Branches::has(std::string_view name) const { return std::ranges::find(all, name, &Branch::name) != all.end(); }

std::string Branches::free_name() const {
  for (std::size_t k = all.size() + 1;; ++k)
    if (std::string name = fmt::format("branch {}", k); !has(name)) return name;
}

}  // namespace nextview
