// The runs that a certificate draws.
#include "proof/replay/example_run.h"
#include "proof/space/plain_space.h"
#include "surface/plot/run_picture.h"
#include "surface/report/report_parts.h"

#include <algorithm>
#include <set>

namespace feedhold::certificate {

namespace {

constexpr std::size_t kMostPictures = 4; // of a program; the others can be drawn with the commands that stand there

class RunDrawing {
public:
  RunDrawing(const ProvedFile &file, const ProvedProgram &program) : file_(file), program_(program) {}

  ShownRun draw(const prove::Witness &witness, std::string witnessOf, const RunOptions &options,
                const RunResult &result) const {
    const TypedWitness call = typed(witness, file_, program_, {.result = none_});
    ShownRun shown{std::move(witnessOf), feedhold::textOf(call), optionsBehindFile(call, file_), {}, {}};
    const PicturedRun run{*file_.project, start(), options, result, shown.call};
    RunPicture picture = drawRuns(shown.call, std::span(&run, 1));
    shown.svg = std::move(picture.svg);
    shown.notes = std::move(picture.notes);
    shown.notes.insert(shown.notes.end(), picture.gouges.begin(), picture.gouges.end());
    return shown;
  }
  std::vector<ShownRun> refutations() const {
    std::vector<ShownRun> runs;
    std::set<std::string> drawn;
    for (const prove::Obligation &obligation : program_.proof.obligations) {
      if (!obligation.verdict.witness() || !obligation.verdict.witness()->gouge || runs.size() == kMostPictures)
        continue;
      const TypedWitness call = typed(*obligation.verdict.witness(), file_, program_, {.result = none_});
      if (!drawn.insert(call.options).second)
        continue;
      RunOptions options{.variables = obligation.verdict.witness()->variables};
      options = prove::startedAsSaid(*file_.project->set, start(), file_.file().contracts, std::move(options));
      runs.push_back(
          draw(*obligation.verdict.witness(), obligation.id, options, run(*file_.project->set, start(), options)));
    }
    return runs;
  }
  std::vector<ShownRun> example() const {
    const auto found = prove::exampleRun(*file_.project->set, start(), file_.file().contracts);
    const bool moves = found && std::any_of(found->result.moves.begin(), found->result.moves.end(),
                                            [](const RecordedMove &move) { return move.move.kind != MoveKind::Dwell; });
    if (!moves)
      return {};
    const prove::Witness call{.variables = found->options.variables, .end = found->result.end, .happened = {}};
    return {draw(call, {}, found->options, found->result)};
  }

private:
  Callee start() const {
    return {FileId(0), file_.project->set->file(FileId(0)).cfg.entryOf(program_.program), program_.program};
  }

  const ProvedFile &file_;
  const ProvedProgram &program_;
  const ProofsResult none_{};
};

} // namespace

std::string optionsBehindFile(const TypedWitness &run, const ProvedFile &file) {
  return run.options.substr(quotedWord(file.file().shown).size());
}

std::vector<ShownRun> shownRuns(const ProvedFile &file, const ProvedProgram &program) {
  const RunDrawing drawing(file, program);
  std::vector<ShownRun> runs = drawing.refutations();
  return runs.empty() ? drawing.example() : runs;
}

} // namespace feedhold::certificate
