// Verdicts for people: what is refuted with the call that shows it, what is unknown with what is missing, then what is
// proved.
#include "base/diag/render.h"
#include "base/support/text.h"
#include "surface/sink/prove_shown.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

using prove::Obligation;
using prove::Verdict;

namespace {

constexpr int kMarginDecimals = 6;

/// Those that are not empty.
std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    if (!line.empty())
      lines.push_back(line);
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return lines;
}

class ProgramText {
public:
  ProgramText(const ProveReport &report, const ProvedFile &file, const ProvedProgram &program)
      : report_(report), file_(file), program_(program) {}

  std::string write() {
    VerdictCounts counts;
    counts.add(program_.proof);
    text_ = fmt::format("{}: {}: {}\n", file_.file().shown, programName(file_, program_), textOf(counts));
    const auto inSpace = std::ranges::find_if(program_.proof.obligations,
                                              [](const Obligation &row) { return row.tolerance.has_value(); });
    if (inSpace != program_.proof.obligations.end())
      text_ += fmt::format("  claims about space hold within {}\n", decimalText(*inSpace->tolerance, kMarginDecimals));
    if (const std::optional<Decimal> corner = roundedCorner())
      text_ += fmt::format("  claims about space hold wherever the tool is within {} of the programmed path\n",
                           corner->toString());
    if (program_.proof.incomplete)
      text_ += fmt::format("  not all paths were explored: {}\n", *program_.proof.incomplete);
    text_ += '\n';
    const std::vector<const Obligation *> alarms = alarmsOfTable();
    forEach(Verdict::Refuted, [&](const Obligation &obligation) {
      if (std::ranges::find(alarms, &obligation) == alarms.end())
        picture(obligation, witnessNotes(obligation));
      else if (&obligation == alarms.front())
        table(alarms);
    });
    forEach(Verdict::Unknown, [&](const Obligation &obligation) {
      picture(obligation, {fmt::format("{}", obligation.verdict.reason())});
    });
    const std::size_t before = text_.size();
    forEach(Verdict::Proved, [&](const Obligation &obligation) { line(obligation); });
    forEach(Verdict::Unreachable, [&](const Obligation &obligation) { line(obligation); });
    if (text_.size() != before)
      text_ += '\n';
    return std::move(text_);
  }

private:
  template <typename Visit> void forEach(Verdict::Kind verdict, Visit visit) {
    for (const Obligation &obligation : program_.proof.obligations)
      if (obligation.verdict == verdict)
        visit(obligation);
  }

  /// Alarms that calls raise, one finding for all: most of them are the guards of the program.  One alone is none.
  std::vector<const Obligation *> alarmsOfTable() {
    std::vector<const Obligation *> alarms;
    forEach(Verdict::Refuted, [&](const Obligation &row) {
      const prove::Guard *guard = row.verdict.guard();
      if (row.kind == prove::ObligationKind::AlarmUnreachable && row.verdict.witness() && !(guard && guard->fix))
        alarms.push_back(&row);
    });
    return alarms.size() > 1 ? alarms : std::vector<const Obligation *>();
  }

  void table(const std::vector<const Obligation *> &alarms) {
    std::vector<std::string> notes;
    for (const Obligation *row : alarms) {
      const TypedWitness witness = typed(*row->verdict.witness(), file_, program_, report_);
      const std::string remedy = row->verdict.guard() ? "; " + remedyOf(*row->verdict.guard()) : "";
      notes.push_back(fmt::format("line {}: {}: {}{} [{}]", lineOf(*row), textOf(witness),
                                  happenedIn(*row->verdict.witness(), *row, file_.project->dialect()), remedy,
                                  row->id));
    }
    notes.push_back("replay the first: " + typed(*alarms.front()->verdict.witness(), file_, program_, report_).run());
    notes.push_back("declare the alarms that are meant with `@ALARM`; `feedhold draft` writes these clauses");
    const Diagnostic diagnostic{.message = fmt::format("{} alarms of this program can be raised", alarms.size()),
                                .span = alarms.front()->span,
                                .notes = std::move(notes)};
    show(diagnostic, *alarms.front());
  }

  std::uint32_t lineOf(const Obligation &row) const {
    return file_.project->file(row.place.file).source.lineOf(row.span.begin);
  }

  void picture(const Obligation &obligation, std::vector<std::string> notes) {
    Diagnostic diagnostic{
        .message = messageOf(obligation, file_.project->dialect()), .span = obligation.span, .notes = std::move(notes)};
    if (obligation.verdict.guard()) {
      diagnostic.notes.push_back(remedyOf(*obligation.verdict.guard()));
      if (obligation.verdict.guard()->fix)
        addFix(diagnostic, *obligation.verdict.guard()->fix, file_.project->file(obligation.place.file).source);
    }
    show(diagnostic, obligation);
  }

  void show(const Diagnostic &diagnostic, const Obligation &obligation) {
    const auto fileOf = [&](FileId id) -> const SourceFile & { return file_.project->file(id).source; };
    text_ += render(diagnostic, {nameOf(obligation.verdict), obligation.id},
                    file_.project->file(obligation.place.file).source, fileOf, {.colour = report_.colour});
    text_ += '\n';
  }

  /// With its blocks: they are there to be typed.
  static void addFix(Diagnostic &diagnostic, FixIt fix, const SourceFile &source) {
    for (const Edit &edit : fix.edits) {
      const bool isBehind = edit.replacement.starts_with('\n') || edit.replacement.starts_with('\r');
      fix.title += fmt::format("\n{} line {}:", isBehind ? "after" : "before", source.lineOf(edit.span.begin));
      for (const std::string_view block : linesOf(edit.replacement))
        fix.title += fmt::format("\n    {}", block);
    }
    diagnostic.fixes.push_back(std::move(fix));
  }

  /// By how much the machine rounds corners, where a claim looks at it.
  std::optional<Decimal> roundedCorner() const {
    const Contract *contract = file_.file().contracts.of(program_.program);
    const bool isLookedAt = std::ranges::any_of(program_.proof.obligations, [](const Obligation &row) {
      return row.kind == prove::ObligationKind::KeepIn || row.kind == prove::ObligationKind::KeepOut ||
             row.kind == prove::ObligationKind::Clearance;
    });
    if (contract == nullptr || !isLookedAt || cornerOf(*contract).isZero())
      return std::nullopt;
    return cornerOf(*contract);
  }

  std::vector<std::string> witnessNotes(const Obligation &obligation) const {
    if (!obligation.verdict.witness())
      return {std::string(obligation.verdict.reason())};
    const TypedWitness witness = typed(*obligation.verdict.witness(), file_, program_, report_);
    std::vector<std::string> notes{
        fmt::format("{}: {}", textOf(witness),
                    happenedIn(*obligation.verdict.witness(), obligation, file_.project->dialect())),
        "replay it: " + witness.run()};
    if (obligation.tolerance && obligation.verdict.witness()->happened.ends_with(prove::kByRounding))
      notes.push_back(
          fmt::format("{} is allowed; move in G90, or round each step to whole increments before the loop, or "
                      "state what the part allows: `@TOLERANCE 0.05`",
                      decimalText(*obligation.tolerance, kMarginDecimals)));
    if (obligation.kind == prove::ObligationKind::AlarmUnreachable)
      notes.emplace_back("if the alarm is meant for such calls, declare it in the contract with `@ALARM`");
    if (obligation.verdict.witness()->gouge)
      notes.push_back(fmt::format("draw it: {} -o gouge.svg", witness.plot()));
    return notes;
  }

  static std::string whyOf(const Obligation &obligation) {
    const prove::Verdict &verdict = obligation.verdict;
    const std::string_view reason = verdict.reason();
    if (const auto margin = verdict.margin())
      return fmt::format(
          "{}{}{}",
          *margin > 0
              ? fmt::format("keeps at least {} away", decimalText(*margin, kMarginDecimals))
              : std::string(
                    obligation.tolerance
                        ? "margin 0: the tool reaches the boundary of the region, or passes it within the tolerance"
                        : "margin 0: the tool reaches the boundary of the region"),
          reason.empty() ? "" : "; ", reason);
    if (verdict.bound().empty())
      return std::string(reason);
    return fmt::format("at most `{}` iterations{}{}", verdict.bound(), reason.empty() ? "" : ": ", reason);
  }

  void line(const Obligation &obligation) {
    const std::string_view grade = obligation.verdict.grade() ? nameOf(*obligation.verdict.grade()) : "";
    text_ += fmt::format("{:<11} {:<12} line {:>4}  {}  [{}]\n", nameOf(obligation.verdict), grade, lineOf(obligation),
                         claimOf(obligation, file_.project->dialect()), obligation.id);
    if (const std::string why = whyOf(obligation); !why.empty())
      text_ += fmt::format("            {}\n", why);
    if (obligation.verdict.exactOnly())
      text_ += fmt::format("            {}\n", kExactOnly);
    for (const std::string &assumed : assumedIn(obligation))
      text_ += fmt::format("            {}\n", assumed);
    if (report_.showMethods == ShowMethods::Yes && !obligation.verdict.method().empty())
      text_ += fmt::format("            by {}, effort {}\n", obligation.verdict.method(), obligation.effort);
  }

  const ProveReport &report_;
  const ProvedFile &file_;
  const ProvedProgram &program_;
  std::string text_;
};

} // namespace

std::string writeProveText(const ProveReport &report) {
  std::string text;
  for (const ProvedFile &file : report.result.files)
    for (const ProvedProgram &program : file.programs)
      text += ProgramText(report, file, program).write();
  return text;
}

std::string defectsText(const ProveReport &report) {
  std::string text;
  for (const ProvedFile &file : report.result.files)
    for (const ProvedProgram &program : file.programs)
      for (const prove::Contradiction &each : program.proof.contradictions) {
        const TypedWitness call = typed(each.run, file, program, report);
        text +=
            fmt::format("bug in Feedhold: {} was {}, and a run contradicts it: {}: {}\n"
                        "  replay it: {}\n  the verdict has been withdrawn; please report this program and this call\n",
                        each.id, each.verdict, textOf(call), each.run.happened, call.run());
      }
  return text;
}

std::string proveSummary(const ProveReport &report) {
  VerdictCounts counts;
  std::size_t programs = 0;
  for (const ProvedFile &file : report.result.files)
    for (const ProvedProgram &program : file.programs) {
      counts.add(program.proof);
      ++programs;
    }
  return fmt::format("{} in {} program{}{}\n", textOf(counts), programs, programs == 1 ? "" : "s",
                     report.arithmetic == "exact" ? ", in exact arithmetic: the control rounds, and may break them"
                                                  : "");
}

} // namespace feedhold
