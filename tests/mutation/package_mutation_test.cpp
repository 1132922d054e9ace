// Mutation of packages: what runs break of a contract must not be proved, and is refuted in most cases.
// MUTATION_PACKAGES chooses how many mutants are tried; MUTATION_SEED, which.
#include "base/support/parallel.h"
#include "mutation/mutants.h"
#include "mutation/packages.h"
#include "mutation/replay.h"
#include "proof/prove/exact_run.h"
#include "proof/prove/prove.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <iostream>
#include <map>
#include <memory>

namespace feedhold::mutation {
namespace {

using prove::Obligation;
using prove::ObligationKind;
using prove::Verdict;
using soundness::ProgramLines;
using soundness::Random;

constexpr int kRuns = 60;

std::uint64_t numberFrom(const char *variable, std::uint64_t usual) {
  const char *text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : usual;
}

struct Original {
  PackageText text;
  std::vector<Start> starts = {};
  std::vector<Mutant> mutants = {};
};

/// What became of the claims that runs break.
struct Judged {
  bool isBroken = false;
  bool isRefuted = false;           // some claim, with a witness
  std::vector<std::string> rounded; // proved, and broken only where doubles come out elsewhere than exact numbers
  std::vector<std::string> wrong;   // proved, and broken
  std::vector<std::string> open;    // what is broken and not refuted, with what is said of it
};

bool speaksOf(const Obligation &obligation, const Break &found) {
  if (obligation.kind != found.kind)
    return false;
  switch (found.kind) {
  case ObligationKind::KeepIn:
  case ObligationKind::KeepOut:
    return obligation.place == found.place && obligation.id.find("." + found.name + ".") != std::string::npos;
  case ObligationKind::NoControlAlarm:
    return obligation.place == found.place && obligation.span == found.span &&
           meaningOf(*obligation.alarm) == found.name;
  case ObligationKind::AlarmUnreachable: return obligation.place == found.place && obligation.span == found.span;
  case ObligationKind::Clearance:
  case ObligationKind::Travel:
  case ObligationKind::Limit:
  case ObligationKind::CallMeetsContract:
  case ObligationKind::LoopEnds: return obligation.place == found.place;
  case ObligationKind::Ensures:
  case ObligationKind::ModalPreserved:
  case ObligationKind::AlarmIff: return obligation.claim == found.name;
  case ObligationKind::ProgramEnds:
  case ObligationKind::Assigns:
  case ObligationKind::Guarded:
  case ObligationKind::ContractSatisfiable: return true;
  }
  return false;
}

prove::ProgramProof provedKinds(const ReplayedProgram &program, const std::vector<Break> &breaks) {
  prove::ProveOptions options;
  for (const Break &each : breaks)
    options.only.push_back(each.kind);
  options.guards = prove::InferGuards::No;
  options.contractsOf = {&program.contracts()};
  return prove::prove(program.loaded().set, program.entry(), &program.contracts(), options);
}

/// What was proved is excused by calls close by that keep the claim, if the same run in exact numbers does not come to
/// the same end, or is too long to tell.
bool isByRounding(const ReplayedProgram &program, const Start &start, const Break &found) {
  return prove::agreesExactly(program.loaded().set, program.entry(), start.given, program.run(start)) !=
             prove::Agreement::Same &&
         !program.isBrokenAround(found, start);
}

Judged judged(const ProgramLines &lines, const std::vector<Start> &starts) {
  const ReplayedProgram program(lines);
  Judged result;
  const std::vector<Break> breaks = program.breaks(starts);
  result.isBroken = !breaks.empty();
  if (breaks.empty())
    return result;
  const prove::ProgramProof proof = provedKinds(program, breaks);
  result.isRefuted = std::any_of(proof.obligations.begin(), proof.obligations.end(), [&](const Obligation &each) {
    return each.verdict == Verdict::Refuted && each.witness &&
           (each.kind != ObligationKind::AlarmUnreachable || // of alarms that may be raised, a promise speaks
            std::any_of(breaks.begin(), breaks.end(), [&](const Break &found) { return speaksOf(each, found); }));
  });
  for (const Break &each : breaks) {
    const Start &start = starts[each.start];
    const auto said = std::find_if(proof.obligations.begin(), proof.obligations.end(),
                                   [&](const Obligation &obligation) { return speaksOf(obligation, each); });
    const bool isClaimed = said != proof.obligations.end();
    const std::string text = fmt::format(
        "{} {}: {} ({}); {}", nameOf(each.kind), each.name, each.what, program.textOf(start),
        !isClaimed             ? std::string("nothing is claimed")
        : holds(said->verdict) ? fmt::format("{} is {}", said->id, nameOf(said->verdict))
                               : fmt::format("{} is {}: {}", said->id, nameOf(said->verdict), said->reason));
    const bool isTakenToHold = isClaimed ? holds(said->verdict) : !proof.incomplete;
    if (isTakenToHold && isByRounding(program, start, each))
      result.rounded.push_back(text);
    else if (isTakenToHold)
      result.wrong.push_back(text);
    else if (!isClaimed || said->verdict != Verdict::Refuted)
      result.open.push_back(text);
  }
  return result;
}

std::vector<Original> originals() {
  std::vector<Original> all;
  for (PackageText &package : provedPackages())
    all.push_back({std::move(package)});
  parallelFor(all.size(), 0, [&](std::size_t i) {
    Random random(i + 1);
    all[i].starts = ReplayedProgram(all[i].text.lines).starts(random, kRuns);
    all[i].mutants = movingMutantsOf(all[i].text.lines);
  });
  return all;
}

/// Without the calls on which doubles alone already lead the program itself elsewhere.
void dropRounded(std::vector<Original> &programs) {
  parallelFor(programs.size(), 0, [&](std::size_t i) {
    const ReplayedProgram program(programs[i].text.lines);
    std::erase_if(programs[i].starts, [&](const Start &start) { return !program.breaks({start}).empty(); });
  });
}

struct Choice {
  const Original *original;
  const Mutant *mutant;
  Judged judged = {};
};

/// In an order of their own, as many of each program as it has.
std::vector<Choice> chosen(const std::vector<Original> &programs, std::size_t most, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::vector<const Mutant *>> left;
  std::size_t count = 0;
  for (const Original &original : programs) {
    auto &mutants = left.emplace_back();
    for (const Mutant &mutant : original.mutants)
      mutants.push_back(&mutant);
    count += mutants.size();
  }
  std::vector<Choice> choices;
  while (choices.size() < std::min(most, count))
    for (std::size_t i = 0; i < programs.size() && choices.size() < most; ++i)
      if (auto &mutants = left[i]; !mutants.empty()) {
        std::swap(mutants[random.below(static_cast<std::uint32_t>(mutants.size()))], mutants.back());
        choices.push_back({&programs[i], mutants.back()});
        mutants.pop_back();
      }
  return choices;
}

std::string headOf(const Choice &choice) {
  const Mutant &mutant = *choice.mutant;
  return fmt::format("{}, {}: `{}` for `{}`", choice.original->text.name, mutant.slip, mutant.lines[mutant.line],
                     choice.original->text.lines[mutant.line]);
}

struct Row {
  int mutants = 0;
  int broken = 0;
  int refuted = 0;
  int open = 0;
  int byRounding = 0;
  int wrong = 0;

  void add(const Judged &judged) {
    ++mutants;
    broken += judged.isBroken ? 1 : 0;
    refuted += judged.isBroken && judged.isRefuted ? 1 : 0;
    byRounding += !judged.rounded.empty() ? 1 : 0;
    wrong += judged.wrong.empty() ? 0 : 1;
    open += judged.isBroken && !judged.isRefuted && judged.rounded.empty() && judged.wrong.empty() ? 1 : 0;
  }
};

void report(const std::vector<Choice> &choices) {
  std::map<std::string_view, Row> slips;
  Row all;
  for (const Choice &choice : choices) {
    const Judged &judged = choice.judged;
    slips[choice.mutant->slip].add(judged);
    all.add(judged);
    for (const std::string &rounded : judged.rounded)
      std::cout << headOf(choice) << "\n  by rounding: " << rounded << "\n";
    for (const std::string &wrong : judged.wrong)
      ADD_FAILURE() << headOf(choice) << ": " << wrong;
    if (judged.isBroken && !judged.isRefuted && !judged.open.empty())
      std::cout << headOf(choice) << "\n  not refuted: " << judged.open.front() << "\n";
  }
  slips["all"] = all;
  for (const auto &[slip, row] : slips)
    std::cout << fmt::format("{:20} {:5} mutants, {:5} break their contract, {:5} of these refuted, {:4} unknown, "
                             "{:3} by rounding alone, {} wrong\n",
                             slip, row.mutants, row.broken, row.refuted, row.open, row.byRounding, row.wrong);
  EXPECT_LE((all.broken - all.byRounding) * 9, all.refuted * 10);
}

TEST(PackageMutation, ProvedPackagesKeepTheirContractsInRuns) {
  const std::vector<Original> programs = originals();
  ASSERT_FALSE(programs.empty());
  std::vector<std::string> said(programs.size());
  parallelFor(programs.size(), 0, [&](std::size_t i) {
    const ReplayedProgram program(programs[i].text.lines);
    for (const Break &each : program.breaks(programs[i].starts))
      if (!isByRounding(program, programs[i].starts[each.start], each))
        said[i] += fmt::format("{} {}: {} ({})\n", nameOf(each.kind), each.name, each.what,
                               program.textOf(programs[i].starts[each.start]));
  });
  for (std::size_t i = 0; i < programs.size(); ++i) {
    EXPECT_EQ(said[i], "") << programs[i].text.name;
    std::cout << fmt::format("{}: {} calls, {} mutants\n", programs[i].text.name, programs[i].starts.size(),
                             programs[i].mutants.size());
  }
}

TEST(PackageMutation, WhatRunsBreakIsNotProved) {
  constexpr std::uint64_t kUsual = 30;
  std::vector<Original> programs = originals();
  ASSERT_FALSE(programs.empty());
  dropRounded(programs);
  std::vector<Choice> choices =
      chosen(programs, numberFrom("MUTATION_PACKAGES", kUsual), numberFrom("MUTATION_SEED", 1));
  parallelFor(choices.size(), 0, [&](std::size_t i) {
    choices[i].judged = judged(choices[i].mutant->lines, choices[i].original->starts);
  });
  report(choices);
}

} // namespace
} // namespace feedhold::mutation
