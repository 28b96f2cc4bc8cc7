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

/// Another session takes the place of this one, or may.
inline bool opens_another(const SessionRequest& r) { return starts_anew(r) || is<request::OfferSession>(r); }

}  // namespace nextview
