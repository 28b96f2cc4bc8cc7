#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

/// A way that a session has gone along: all steps up to its tip.
struct Branch {
  std::string name;
  std::uint32_t tip = 0;  ///< number of its last step; 0: it has none
  std::uint32_t id = 0;   ///< that it keeps under any name, and that no other one ever had

  bool operator==(const Branch&) const = default;
};

/// The branches of a session, and the one that it is on.
struct Branches {
  std::vector<Branch> all = {{"main", 0}};  ///< never empty, no two of one name
  std::size_t on = 0;
  std::uint32_t next_id = 1;

  Branch& current() { return all[on]; }
  const Branch& current() const { return all[on]; }
  /// A step was taken after another one. From the tip the branch goes on; from anywhere else a new one begins, and what
  /// the old one has stays. Returns whether it is new.
  bool add_step(std::uint32_t number, std::uint32_t after);
  /// Another one from a step on; the session is on it then. @throws std::invalid_argument: the name is no name, or
  /// taken
  void begin(const std::string& name, std::uint32_t at);
  /// @throws std::invalid_argument: there is none of this name, or the new name is no name, or taken
  void rename(std::string_view name, const std::string& to);
  /// Its steps stay in the journal. @throws std::invalid_argument: there is none, or the session is on it
  void remove(std::string_view name);
  /// @throws std::invalid_argument: there is none, with those that there are
  std::size_t find(std::string_view name) const;
  bool has(std::string_view name) const;
  /// "branch 2", or the next that is free.
  std::string free_name() const;
  /// Those of another time, on the one of then, with what they have gained since; what has begun since stays if it has
  /// steps of its own, what was removed since is back, and what was removed then is not. `leads_through(tip, step)`
  /// tells whether a step is on the way to another one.
  template <class LeadsThrough>
  Branches back_to(const Branches& then, const LeadsThrough& leads_through) const;

  bool operator==(const Branches&) const = default;

 private:
  void add(std::string name, std::uint32_t tip);
};

template <class LeadsThrough>
Branches Branches::back_to(const Branches& then, const LeadsThrough& leads_through) const {
  Branches result = then;
  result.next_id = next_id;
  for (const Branch& now : all) {
    const auto same = std::ranges::find(result.all, now.id, &Branch::id);
    if (same != result.all.end())
      same->tip = now.tip;
    else if (now.id >= then.next_id &&
             std::ranges::none_of(result.all, [&](const Branch& b) { return leads_through(b.tip, now.tip); }))
      result.all.push_back({result.has(now.name) ? result.free_name() : now.name, now.tip, now.id});
  }
  return result;
}

}  // namespace nextview
