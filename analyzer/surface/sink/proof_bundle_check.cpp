// What has become of a bundle: compared with a new proof of the same, and followed certificate by certificate.
#include "proof/check/certificate.h"
#include "proof/smt/solver.h"
#include "surface/sink/proof_bundle.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace feedhold {

namespace {

using Json = nlohmann::ordered_json;

/// The rows of a list by the text of one of their members.
std::map<std::string, Json> rowsBy(const Json &rows, const char *member) {
  std::map<std::string, Json> result;
  for (const Json &row : rows)
    result.emplace(row.at(member), row);
  return result;
}

class Comparison {
public:
  std::vector<std::string> run(const Bundle &stored, const Bundle &now) {
    const std::string name(kBundleIndex);
    if (!stored.contains(name)) {
      say("`{}` is missing", name);
      return std::move(problems_);
    }
    try {
      const Json before = Json::parse(stored.at(name));
      const auto files = rowsBy(before.at("files"), "path");
      for (const auto &[path, file] : rowsBy(Json::parse(now.at(name)).at("files"), "path"))
        if (const auto known = files.find(path); known != files.end())
          compareFile(known->second, file);
        else
          say("`{}` is not in the bundle", path);
      if (problems_.empty())
        compareTexts(stored, now);
    } catch (const Json::exception &) {
      say("`{}` is not as it was written", name);
    }
    return std::move(problems_);
  }

private:
  void compareFile(const Json &before, const Json &now) {
    const auto newSources = rowsBy(now.at("sources"), "path");
    const auto oldSources = rowsBy(before.at("sources"), "path");
    for (const auto &[path, source] : oldSources)
      if (const auto known = newSources.find(path); known == newSources.end())
        say("`{}` was read for the proof and is gone", path);
      else if (known->second.at("sha256") != source.at("sha256"))
        say("`{}` is not what it was when it was proved", path);
    for (const auto &[path, source] : newSources)
      if (!oldSources.contains(path))
        say("`{}` is new beside the program", path);
    if (before.at("dialect") != now.at("dialect"))
      say("it was read for {}, now for {}", std::string(before.at("dialect")), std::string(now.at("dialect")));
    compareObligations(rowsBy(before.at("obligations"), "id"), rowsBy(now.at("obligations"), "id"));
  }
  void compareObligations(const std::map<std::string, Json> &before, const std::map<std::string, Json> &now) {
    for (const auto &[id, row] : before)
      if (!now.contains(id))
        say("{}: there is no such obligation", id);
    for (const auto &[id, row] : now) {
      const auto known = before.find(id);
      if (known == before.end())
        say("{}: this obligation is missing in the bundle", id);
      else if (known->second.at("verdict") != row.at("verdict"))
        say("{}: the bundle says {}, and it is {}", id, std::string(known->second.at("verdict")),
            std::string(row.at("verdict")));
      else if (known->second != row)
        say("{}: the bundle does not say of it what a proof now gives", id);
    }
  }
  void compareTexts(const Bundle &stored, const Bundle &now) {
    for (const auto &[name, text] : now)
      if (const auto known = stored.find(name); known == stored.end())
        say("`{}` is missing", name);
      else if (known->second != text)
        say("`{}` is not as it was written", name);
    for (const auto &[name, text] : stored)
      if (!now.contains(name))
        say("`{}` does not belong to the bundle", name);
  }

  template <typename... Arguments> void say(fmt::format_string<Arguments...> format, Arguments &&...arguments) {
    problems_.push_back(fmt::format(format, std::forward<Arguments>(arguments)...));
  }
  std::vector<std::string> problems_;
};

/// Absent: the certificate shows that the claim is contradictory.
std::optional<Error> followed(const std::string &claimText, const std::string &certificateText) {
  const Result<check::Claim> claim = check::readClaim(claimText);
  if (!claim)
    return claim.error();
  const Result<check::Certificate> certificate = check::readCertificate(claim.value(), certificateText);
  if (!certificate)
    return certificate.error();
  return check::verify(claim.value(), certificate.value());
}

/// Absent: both solvers refute the text.
std::optional<Error> solved(const std::string &text, BundleCheck &check) {
  const prove::Budget budget;
  smt::TermStore store;
  const Result<std::vector<smt::TermId>> formulas = smt::readSmtLib(store, text);
  if (!formulas)
    return formulas.error();
  const bool z3 = smt::askZ3(text, smt::arithmeticOf(store, formulas.value()), budget.z3).isUnsat();
  const bool cvc5 = smt::askCvc5(text, budget.cvc5).isUnsat();
  check.byZ3 += z3 ? 1 : 0;
  check.byCvc5 += cvc5 ? 1 : 0;
  if (z3 && cvc5)
    return std::nullopt;
  return Error{z3     ? "Z3 refutes it, and cvc5 does not"
               : cvc5 ? "cvc5 refutes it, and Z3 does not"
                      : "neither Z3 nor cvc5 refutes it"};
}

} // namespace

std::vector<std::string> differences(const Bundle &stored, const Bundle &now) { return Comparison().run(stored, now); }

BundleCheck checkEvidence(const Bundle &bundle) {
  BundleCheck result;
  for (const auto &[name, text] : bundle) {
    std::optional<Error> wrong;
    if (name.ends_with(".claim")) {
      const auto certificate = bundle.find(name.substr(0, name.rfind('.')) + ".certificate");
      wrong = certificate == bundle.end() ? Error{"it has no certificate"} : followed(text, certificate->second);
      ++result.certificates;
    } else if (name.ends_with(".smt2")) {
      wrong = solved(text, result);
      ++result.solved;
    }
    if (wrong)
      result.problems.push_back(fmt::format("`{}`: {}", name, wrong->message));
  }
  return result;
}

} // namespace feedhold
