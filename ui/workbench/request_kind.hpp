#pragma once
#include "ui/workbench/session_request.hpp"

namespace nextview {

template <class Request>
bool is(const SessionRequest& request) {
  return std::holds_alternative<Request>(request);
}

inline bool starts_anew(const SessionRequest& r) {
  return is<request::Load>(r) || is<request::OpenFile>(r) || is<request::Reset>(r) || is<request::Connect>(r) ||
         is<request::Disconnect>(r);
}

}  // namespace nextview
