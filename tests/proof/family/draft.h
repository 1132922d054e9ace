// Draft: a program of the family while it is written, with what is known of it by the way it is made.
#pragma once

#include "proof/family/known_answers.h"

#include <initializer_list>
#include <random>
#include <string>
#include <string_view>

namespace feedhold::proof_tests {

/// The same draws on every machine.
class Draw {
public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(engine_() % limit); }
  bool oneIn(std::uint32_t chances) { return below(chances) == 0; }
  template <typename T> T of(std::initializer_list<T> choices) {
    return *(choices.begin() + below(static_cast<std::uint32_t>(choices.size())));
  }

private:
  std::mt19937 engine_;
};

enum class ArgumentKind : std::uint8_t { Real, Whole };
enum class Presence : std::uint8_t { Given, Optional };

/// A variable that the program reads before it writes it.
struct Argument {
  std::uint32_t variable;
  double low;
  double high;
  ArgumentKind kind = ArgumentKind::Real;
  Presence presence = Presence::Given;
};

/// A number as a program writes it: never like a whole number with a comma of thousands, or with an exponent.
std::string num(double value);

class Draft {
public:
  explicit Draft(std::string name) : name_(std::move(name)) {}

  /// With a clause of the contract, behind the O word, where the program reads it at all.
  Draft &promised(const Argument &argument);
  /// Without: it may hold anything, or nothing.
  Draft &free(std::uint32_t variable);
  Draft &line(std::string_view block);
  Draft &lines(std::initializer_list<std::string_view> blocks);
  /// Behind the end of the program: others that it calls.
  Draft &other(std::initializer_list<std::string_view> blocks);

  Draft &proved(std::string_view claim);
  Draft &refuted(std::string_view claim, Inputs shownBy);

  /// Ends with M30 where no other end was written.
  KnownProgram done() const;

private:
  std::string name_;
  std::string body_;
  std::string others_;
  std::vector<Argument> promised_;
  std::vector<std::uint32_t> free_;
  std::vector<KnownAnswer> answers_;
};

using Family = std::vector<KnownProgram>;

// ---- its parts, one file each ----
void addCountingLoops(Family &family);
void addSpecialSteps(Family &family);
void addGuards(Family &family);
void addDomains(Family &family);
void addNestedLoops(Family &family);
void addVacancy(Family &family);
void addDispatch(Family &family);
void addCalls(Family &family);
void addPhases(Family &family);

} // namespace feedhold::proof_tests
