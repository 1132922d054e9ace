#include "surface/evidence/evidence_check.h"

#include "base/support/parallel.h"
#include "proof/check/certificate.h"
#include "proof/smt/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

namespace feedhold {

namespace {

constexpr std::string_view kQuestionEnd = ".smt2";
constexpr std::string_view kCertificateEnd = ".certificate";

/// Of what one thread takes at a time: cvc5 takes longer to start than to answer.
constexpr std::size_t kTogether = 50;

constexpr prove::Budget kBudget;
/// What is certified needs no solver: this is for a second opinion.  Measured: ten times as much for Z3 takes minutes
/// more on 677 questions of the corpus, and the checker has followed them all.
constexpr prove::Budget kOpinion{.search = 0, .z3 = 200'000, .cvc5 = 40'000};

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
std::optional<Error> follow(const check::UnsatProblem &claim, const std::string &text) {
  const Result<check::Certificate> certificate = check::readCertificate(claim, text);
  return certificate ? check::verify(claim, certificate.value()) : certificate.error();
}

void checkCertified(Question &question, const std::string &text, const std::string &certificate) {
  const Result<check::UnsatProblem> claim = check::readClaim(text);
  const std::optional<Error> wrong = claim ? follow(claim.value(), certificate) : claim.error();
  question.isFollowed = !wrong;
  if (wrong)
    question.problem = wrong->message;
}

smt::Arithmetic arithmeticOf(const std::string &text) {
  const Result<check::UnsatProblem> claim = check::readClaim(text);
  return claim && !hasProducts(claim.value().conjunction) ? smt::Arithmetic::Linear : smt::Arithmetic::Nonlinear;
}

void contradict(Question &question) {
  for (const auto &[says, name] : {std::pair(question.z3, "Z3"), std::pair(question.cvc5, "cvc5")})
    if (says == SolverSays::Satisfiable)
      question.problem = fmt::format("the checker verified its certificate, but {} finds it satisfiable", name);
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
    question.problem = z3     ? "Z3 refutes it, but cvc5 does not"
                       : cvc5 ? "cvc5 refutes it, but Z3 does not"
                              : "neither Z3 nor cvc5 refutes it";
}

std::string certificateOf(const std::string &file) {
  return file.substr(0, file.size() - kQuestionEnd.size()) + std::string(kCertificateEnd);
}

/// Programs have questions in common.
using QuestionsByText = std::map<std::string_view, std::vector<Question *>>;

void giveOpinions(std::span<const QuestionsByText::value_type *const> asked) {
  std::vector<std::string> texts;
  for (const auto *row : asked)
    texts.emplace_back(row->first);
  const std::vector<smt::Answer> fromCvc5 = smt::askCvc5InTurn(texts, kOpinion.cvc5);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const SolverSays z3 = saysOf(smt::askZ3(texts[i], arithmeticOf(texts[i]), kOpinion.z3));
    for (Question *question : asked[i]->second) {
      question->z3 = z3;
      question->cvc5 = saysOf(fromCvc5[i]);
      contradict(*question);
    }
  }
}

/// Of what the checker follows.
void giveOpinions(const Bundle &bundle, std::vector<Question> &questions, unsigned jobs) {
  QuestionsByText byText;
  for (Question &question : questions)
    if (question.isFollowed)
      byText[bundle.at(question.file)].push_back(&question);
  std::vector<const QuestionsByText::value_type *> rows;
  for (const auto &row : byText)
    rows.push_back(&row);
  const std::size_t groups = (rows.size() + kTogether - 1) / kTogether;
  parallelFor(groups, jobs, [&](std::size_t group) {
    const std::size_t first = group * kTogether;
    giveOpinions(std::span(rows).subspan(first, std::min(kTogether, rows.size() - first)));
  });
}

} // namespace

std::string_view nameOf(SolverSays says) {
  switch (says) {
  case SolverSays::Refutes: return "refutes it";
  case SolverSays::Satisfiable: return "finds it satisfiable";
  case SolverSays::NoAnswer: return "gives no answer";
  case SolverSays::NotAsked: return "was not asked";
  }
  return "";
}

std::vector<Question> checkEvidence(const Bundle &bundle, const EvidenceOptions &options) {
  std::vector<Question> questions;
  for (const auto &[name, text] : bundle)
    if (name.ends_with(kQuestionEnd))
      questions.push_back({.file = name, .hasCertificate = bundle.contains(certificateOf(name))});
  parallelFor(questions.size(), options.jobs, [&](std::size_t index) {
    Question &question = questions[index];
    const std::string &text = bundle.at(question.file);
    if (question.hasCertificate)
      checkCertified(question, text, bundle.at(certificateOf(question.file)));
    else
      checkSolved(question, text);
  });
  if (options.ask == AskSolvers::Always)
    giveOpinions(bundle, questions, options.jobs);
  return questions;
}

} // namespace feedhold
