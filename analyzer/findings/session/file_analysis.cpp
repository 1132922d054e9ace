#include "findings/session/file_analysis.h"

#include "base/support/record.h"
#include "base/support/sha256.h"

namespace feedhold {

namespace {

void write(RecordWriter &writer, Span span) {
  writer.number(span.begin);
  writer.number(span.end);
}

/// Of one file of a run: what lies in a text is checked against its size.
class FindingReader : public RecordReader {
public:
  FindingReader(std::string_view bytes, const AnalysedRun &run, const SourceFile &source)
      : RecordReader(bytes), run_(run), source_(source) {}

  /// The findings that follow are of another text.
  void goTo(const SourceFile &source) { source_ = source; }
  Span span() { return spanIn(source_); }
  Span spanIn(const SourceFile &source) {
    const std::uint64_t size = source.text().size();
    const auto begin = static_cast<std::uint32_t>(numberUpTo(size));
    return {begin, static_cast<std::uint32_t>(numberUpTo(size))};
  }
  /// Of the run; absent: the file itself.
  std::optional<FileId> file() {
    return isPresent() ? std::optional(FileId(numberUpTo(run_.items.size() - 1))) : std::nullopt;
  }
  const SourceFile &sourceOf(std::optional<FileId> file) const {
    return file ? run_.items[file->index()].source : source_;
  }
  /// The name of a rule; null when there is none.
  const RuleInfo *rule() {
    const RegisteredRule *found = findRule(run_.rules, text());
    if (found != nullptr)
      return &found->rule->info;
    fail();
    return nullptr;
  }

private:
  const AnalysedRun &run_;
  SourceFile source_;
};

void write(RecordWriter &writer, const Label &label) {
  writer.optional(label.file, [&](FileId file) { writer.number(file.index()); });
  write(writer, label.span);
  writer.text(label.text);
}

Label readLabel(FindingReader &reader) {
  const std::optional<FileId> file = reader.file();
  const Span span = reader.spanIn(reader.sourceOf(file));
  return {.span = span, .text = std::string(reader.text()), .file = file};
}

void write(RecordWriter &writer, const FixIt &fix) {
  writer.number(static_cast<std::uint64_t>(fix.safety));
  writer.text(fix.title);
  writer.list(fix.edits, [&](const Edit &edit) {
    write(writer, edit.span);
    writer.text(edit.replacement);
  });
}

FixIt readFix(FindingReader &reader) {
  FixIt fix{.safety = reader.upTo(FixSafety::NeedsReview), .title = std::string(reader.text()), .edits = {}};
  reader.list([&] {
    const Span span = reader.span();
    fix.edits.push_back({span, std::string(reader.text())});
  });
  return fix;
}

void write(RecordWriter &writer, const Diagnostic &diagnostic) {
  // Names every member, so that one that is new has to be thought of here.
  const auto &[message, span, label, labels, flow, notes, fixes] = diagnostic;
  writer.text(message);
  write(writer, span);
  writer.text(label);
  writer.list(labels, [&](const Label &each) { write(writer, each); });
  writer.list(flow, [&](const Label &each) { write(writer, each); });
  writer.list(notes, [&](const std::string &note) { writer.text(note); });
  writer.list(fixes, [&](const FixIt &fix) { write(writer, fix); });
}

Diagnostic readDiagnostic(FindingReader &reader) {
  Diagnostic diagnostic{.message = std::string(reader.text()), .span = reader.span()};
  diagnostic.label = reader.text();
  reader.list([&] { diagnostic.labels.push_back(readLabel(reader)); });
  reader.list([&] { diagnostic.flow.push_back(readLabel(reader)); });
  reader.list([&] { diagnostic.notes.emplace_back(reader.text()); });
  reader.list([&] { diagnostic.fixes.push_back(readFix(reader)); });
  return diagnostic;
}

void write(RecordWriter &writer, const Finding &finding) {
  const auto &[rule, severity, diagnostic, fingerprint, suppressed, reason, allowedIn] = finding;
  writer.text(rule->name);
  writer.number(static_cast<std::uint64_t>(severity));
  write(writer, diagnostic);
  writer.text(fingerprint);
  writer.number(suppressed ? 1 : 0);
  writer.text(reason);
  writer.text(allowedIn);
}

Finding readFinding(FindingReader &reader) {
  const RuleInfo *rule = reader.rule();
  const auto severity = reader.upTo(Severity::Error);
  Finding finding{rule, severity, readDiagnostic(reader), std::string(reader.text())};
  finding.suppressed = reader.isPresent();
  finding.reason = reader.text();
  finding.allowedIn = reader.text();
  return finding;
}

std::vector<Finding> readFindings(FindingReader &reader) {
  std::vector<Finding> findings;
  reader.list([&] { findings.push_back(readFinding(reader)); });
  return findings;
}

/// The text that a file had, as it can be told later.
void write(RecordWriter &writer, const SourceFile &source) {
  writer.text(source.path());
  writer.text(sha256(source.text()));
}

std::optional<SourceFile> readSource(FindingReader &reader) {
  const std::string_view path = reader.text();
  const std::string_view hash = reader.text();
  const Result<SourceFile> file = SourceFile::open(path);
  if (file && sha256(file.value().text()) == hash)
    return file.value();
  reader.fail();
  return std::nullopt;
}

} // namespace

CheckedFile headOf(const WorkItem &item) {
  return {item.shown,   item.source,           item.profile->dialect.id,  item.choice,
          item.reasons, item.profile->errorOn, item.profile->minSeverity, {}};
}

std::string writeFileAnalysis(const FileAnalysis &analysis) {
  const auto &[findings, programs, sidecarPaths, sidecars] = analysis;
  RecordWriter writer;
  const auto writeFinding = [&](const Finding &finding) { write(writer, finding); };
  writer.list(findings, writeFinding);
  writer.list(programs, [&](const ProgramHead &program) {
    writer.text(program.name);
    write(writer, program.header);
  });
  writer.list(sidecarPaths, [&](const std::string &path) { writer.text(path); });
  writer.list(sidecars, [&](const CheckedFile &file) {
    write(writer, file.source);
    writer.list(file.findings, writeFinding);
  });
  return writer.finish();
}

std::optional<FileAnalysis> readFileAnalysis(std::string_view record, const WorkItem &item, const AnalysedRun &run) {
  FindingReader reader(record, run, item.source);
  FileAnalysis analysis;
  analysis.findings = readFindings(reader);
  reader.list([&] {
    const std::string_view name = reader.text();
    analysis.programs.push_back({std::string(name), reader.span()});
  });
  reader.list([&] { analysis.sidecarPaths.emplace_back(reader.text()); });
  reader.list([&] {
    CheckedFile file = headOf(item);
    if (const std::optional<SourceFile> source = readSource(reader)) {
      file.path = source->path();
      file.source = *source;
      reader.goTo(*source);
    }
    file.findings = readFindings(reader);
    analysis.sidecars.push_back(std::move(file));
  });
  return reader.isDone() ? std::optional(std::move(analysis)) : std::nullopt;
}

std::string writeInferred(const std::vector<InferredSetting> &inferred) {
  RecordWriter writer;
  writer.list(inferred, [&](const InferredSetting &setting) {
    const auto &[folder, dialect, table, line, evidence] = setting;
    for (const std::string_view text : {std::string_view(folder), dialect, std::string_view(table),
                                        std::string_view(line), std::string_view(evidence)})
      writer.text(text);
  });
  return writer.finish();
}

std::optional<std::vector<InferredSetting>> readInferred(std::string_view record, const DialectRegistry &dialects) {
  RecordReader reader(record);
  std::vector<InferredSetting> inferred;
  reader.list([&] {
    InferredSetting setting;
    setting.folder = reader.text();
    if (const Dialect *dialect = findDialect(dialects, reader.text()))
      setting.dialect = dialect->id;
    else
      reader.fail();
    setting.table = reader.text();
    setting.line = reader.text();
    setting.evidence = reader.text();
    inferred.push_back(std::move(setting));
  });
  return reader.isDone() ? std::optional(std::move(inferred)) : std::nullopt;
}

} // namespace feedhold
