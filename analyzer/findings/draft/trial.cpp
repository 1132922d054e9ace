// See the header.
#include "findings/draft/trial.h"

#include <algorithm>
#include <array>

namespace feedhold::draft {

namespace {

constexpr std::array kOfEveryProgram = {prove::ObligationKind::LoopEnds, prove::ObligationKind::ProgramEnds,
                                        prove::ObligationKind::AlarmUnreachable, prove::ObligationKind::NoControlAlarm,
                                        prove::ObligationKind::CallMeetsContract};

bool isOfEveryProgram(const prove::Obligation &claim) {
  return std::ranges::find(kOfEveryProgram, claim.kind) != kOfEveryProgram.end();
}

} // namespace

Trial::Trial(const Project &project, ProgramId program, std::string kept, prove::ProveOptions options)
    : project_(project), program_(program), kept_(std::move(kept)), options_(std::move(options)) {}

FileContracts Trial::contractsWith(const std::vector<std::string> &lines) const {
  const ProjectFile &file = project_.file(FileId(0));
  std::string text = kept_;
  for (const std::string &line : lines)
    text += line + "\n";
  std::vector<Sidecar> sidecars;
  const auto number = file.model.programs[program_].name.number;
  sidecars.push_back({SourceFile::fromText("drafted", std::move(text)), number, std::nullopt});
  return readContracts(file.source, file.tree, file.model, *file.dialect, sidecars);
}

bool Trial::areSound(const std::vector<std::string> &lines) const { return contractsWith(lines).issues.empty(); }

prove::ProgramProof Trial::prove(const std::vector<std::string> &lines, std::vector<prove::ObligationKind> only,
                                 prove::InferGuards guards) const {
  const FileContracts contracts = contractsWith(lines);
  prove::ProveOptions options = options_;
  options.only = std::move(only);
  options.guards = guards;
  options.contractsOf = project_.contracts();
  options.contractsOf.front() = &contracts;
  const Callee callee{FileId(0), project_.set->file(FileId(0)).cfg.entryOf(program_), program_};
  return prove::prove(*project_.set, callee, &contracts, options);
}

Score scoreOf(const prove::ProgramProof &proof) {
  Score score;
  for (const prove::Obligation &claim : proof.obligations) {
    ++score.all;
    score.holds += claim.verdict.holds() ? 1 : 0;
  }
  return score;
}

Score scoreBesidePromises(const prove::ProgramProof &proof) {
  Score score;
  for (const prove::Obligation &claim : proof.obligations)
    if (isOfEveryProgram(claim)) {
      ++score.all;
      score.holds += claim.verdict.holds() ? 1 : 0;
    }
  return score;
}

} // namespace feedhold::draft
