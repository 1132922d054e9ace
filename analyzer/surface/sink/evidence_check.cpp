#include "surface/sink/evidence_check.h"

#include "base/support/parallel.h"
#include "proof/check/certificate.h"
#include "proof/smt/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace feedhold {

namespace {

constexpr std::string_view kQuestionEnd = ".smt2";
constexpr std::string_view kCertificateEnd = ".certificate";

/// Of what one thread takes at a time: cvc5 takes longer to start than to answer.
constexpr std::size_t kTogether = 200;

constexpr prove::Budget kBudget;

SolverSays saysOf(const smt::Answer &answer) {
  if (answer.isUnsat())
    return SolverSays::Refutes;
  return std::holds_alternative<smt::Sat>(answer.result) ? SolverSays::Satisfiable : SolverSays::NoAnswer;
}

bool hasProducts(const check::Conjunction &conjunction) {
  for (const check::Constraint &constraint : conjunction.constraints)
    if (check::degree(constraint.polynomial) > 1)
      return true;
  for (const check::Clause &clause : conjunction.clauses)
    for (const check::Conjunction &alternative : clause.alternatives)
      if (hasProducts(alternative))
        return true;
  return false;
}

/// Absent: the certificate shows that the claim cannot be satisfied.
std::optional<Error> follow(const check::Claim &claim, const std::string &text) {
  const Result<check::Certificate> certificate = check::readCertificate(claim, text);
  return certificate ? check::verify(claim, certificate.value()) : certificate.error();
}

/// Gives whether the question is one for solvers, too: of a certificate that fails none is asked.
bool checkCertified(Question &question, const std::string &text, const std::string &certificate, AskSolvers ask) {
  const Result<check::Claim> claim = check::readClaim(text);
  const std::optional<Error> wrong = claim ? follow(claim.value(), certificate) : claim.error();
  if (wrong)
    question.problem = wrong->message;
  if (wrong || ask == AskSolvers::WhereNeeded)
    return false;
  const bool isLinear = !hasProducts(claim.value().conjunction);
  question.z3 = saysOf(smt::askZ3(text, isLinear ? smt::Arithmetic::Linear : smt::Arithmetic::Nonlinear, kBudget.z3));
  return true;
}

void contradict(Question &question) {
  for (const auto &[says, name] : {std::pair(question.z3, "Z3"), std::pair(question.cvc5, "cvc5")})
    if (says == SolverSays::Satisfiable)
      question.problem = fmt::format("the checker follows its certificate, and {} says that it can be satisfied", name);
}

void checkSolved(Question &question, const std::string &text) {
  smt::TermStore store;
  const Result<std::vector<smt::TermId>> formulas = smt::readSmtLib(store, text);
  if (!formulas) {
    question.problem = formulas.error().message;
    return;
  }
  question.z3 = saysOf(smt::askZ3(text, smt::arithmeticOf(store, formulas.value()), kBudget.z3));
  question.cvc5 = saysOf(smt::askCvc5(text, kBudget.cvc5));
  const bool z3 = question.z3 == SolverSays::Refutes;
  const bool cvc5 = question.cvc5 == SolverSays::Refutes;
  if (!z3 || !cvc5)
    question.problem = z3     ? "Z3 refutes it, and cvc5 does not"
                       : cvc5 ? "cvc5 refutes it, and Z3 does not"
                              : "neither Z3 nor cvc5 refutes it";
}

std::string certificateOf(const std::string &file) {
  return file.substr(0, file.size() - kQuestionEnd.size()) + std::string(kCertificateEnd);
}

void checkTogether(const Bundle &bundle, std::span<Question> questions, AskSolvers ask) {
  std::vector<Question *> forCvc5;
  std::vector<std::string> texts;
  for (Question &question : questions) {
    const std::string &text = bundle.at(question.file);
    if (!question.hasCertificate) {
      checkSolved(question, text);
    } else if (checkCertified(question, text, bundle.at(certificateOf(question.file)), ask)) {
      forCvc5.push_back(&question);
      texts.push_back(text);
    }
  }
  const std::vector<smt::Answer> answers = smt::askCvc5InTurn(texts, kBudget.cvc5);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    forCvc5[i]->cvc5 = saysOf(answers[i]);
    contradict(*forCvc5[i]);
  }
}

} // namespace

std::string_view nameOf(SolverSays says) {
  switch (says) {
  case SolverSays::Refutes: return "refutes it";
  case SolverSays::Satisfiable: return "says it can be satisfied";
  case SolverSays::NoAnswer: return "gives no answer";
  case SolverSays::NotAsked: return "is not asked";
  }
  return "";
}

std::vector<Question> checkEvidence(const Bundle &bundle, const EvidenceWish &wish) {
  std::vector<Question> questions;
  for (const auto &[name, text] : bundle)
    if (name.ends_with(kQuestionEnd))
      questions.push_back({.file = name, .hasCertificate = bundle.contains(certificateOf(name))});
  const std::size_t groups = (questions.size() + kTogether - 1) / kTogether;
  parallelFor(groups, wish.jobs, [&](std::size_t group) {
    const std::size_t first = group * kTogether;
    checkTogether(bundle, std::span(questions).subspan(first, std::min(kTogether, questions.size() - first)), wish.ask);
  });
  return questions;
}

} // namespace feedhold
