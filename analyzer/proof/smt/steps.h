// Steps: how much work may be done, counted where it is done, so that a program is given up at the same place on every
// machine and with any number of threads.
//
// A scope for the whole proof of a program keeps the account; the engines within it (a question, an exploration, a
// search for a ranking function) open scopes of their own, which draw from it.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

namespace feedhold::smt {

/// Thrown by spend() out of the innermost scope of Steps::AtEnd::Throw that has no steps left.
struct OutOfSteps {};

class Steps {
public:
  enum class AtEnd : std::uint8_t {
    Throw,
    GoOn, ///< the work that is done between engines: it grows with the program alone
  };

  /// Of this thread, while it lives: no more than so many steps, and no more than the scope around it has left.
  Steps(std::uint64_t most, AtEnd atEnd);
  ~Steps();
  Steps(const Steps &) = delete;
  Steps &operator=(const Steps &) = delete;

  std::uint64_t spent() const { return spent_; }
  bool areUsedUp() const { return spent_ >= most_; }

private:
  friend void spend(std::uint64_t);
  friend std::uint64_t stepsLeft();
  void take(std::uint64_t steps) { spent_ = steps < most_ - spent_ ? spent_ + steps : most_; }

  Steps *outer_;
  std::uint64_t most_;
  std::uint64_t spent_ = 0;
  AtEnd atEnd_;
};

/// About ten nanoseconds of work, or ten bytes of memory that is kept, are a step.  Counts nothing outside of a scope.
void spend(std::uint64_t steps);

/// The scope of this thread that is farthest out has none left.
bool areStepsUsedUp();

/// What the innermost scope of this thread has left; without one: as many as there are.
std::uint64_t stepsLeft();

/// What an engine gives within so many steps; absent when it needs more.
template <typename Engine> std::optional<std::invoke_result_t<Engine>> within(std::uint64_t most, Engine &&engine) {
  const Steps steps(most, Steps::AtEnd::Throw);
  try {
    return engine();
  } catch (const OutOfSteps &) {
    return std::nullopt;
  }
}

} // namespace feedhold::smt
