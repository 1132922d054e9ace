// Result<T>: a value, or the reason why the world (a file, a setting, an outside program) refused.
#pragma once

#include "base/support/check.h"

#include <string>
#include <utility>
#include <variant>

namespace feedhold {

/// What went wrong and what the reader can do about it, in one sentence, lower case, no full stop.
struct Error {
  std::string message;
};

template <typename T> class [[nodiscard]] Result {
public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}

  bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }

  const T &value() const & {
    FEEDHOLD_CHECK(ok(), "value() asked of a Result that holds an error");
    return std::get<T>(state_);
  }
  T &&take() {
    FEEDHOLD_CHECK(ok(), "take() asked of a Result that holds an error");
    return std::move(std::get<T>(state_));
  }
  const Error &error() const {
    FEEDHOLD_CHECK(!ok(), "error() asked of a Result that holds a value");
    return std::get<Error>(state_);
  }

private:
  std::variant<T, Error> state_;
};

} // namespace feedhold
