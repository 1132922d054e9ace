// The search for a certificate: guesses all it likes; the checker decides.
#pragma once

#include "proof/check/certificate.h"

#include <string>
#include <variant>
#include <vector>

namespace feedhold::prove {

struct Found {
  check::Certificate certificate;
};
/// Exact values that satisfy the claim, by variable.
struct Satisfied {
  std::vector<check::Number> values;
};
struct NotFound {
  std::string reason;
};

struct SearchResult {
  std::variant<Found, Satisfied, NotFound> answer;
  std::uint64_t work = 0;
  std::uint64_t steps = 0; // that it took in all (smt/steps.h)
  enum class Reasoning : std::uint8_t { Linear, Products } reasoning = Reasoning::Linear;
};

SearchResult searchCertificate(const check::UnsatProblem &claim, std::uint64_t workLimit);

/// Exactly.
bool satisfies(const check::UnsatProblem &claim, const std::vector<check::Number> &values);

} // namespace feedhold::prove
