#include "findings/project/project_file.h"

#include "language/dialect/remarks.h"
#include "language/parse/parse.h"

namespace feedhold {

namespace {

/// The dialect of the file, in which `;` is what its text makes of it.
std::shared_ptr<const Dialect> dialectOf(const OpenedFile &file) {
  if (file.dialect->grammar.semicolonComment || !hasSemicolonRemarks(file.source.text()))
    return file.dialect;
  auto dialect = std::make_shared<Dialect>(*file.dialect);
  dialect->grammar.semicolonComment = true;
  return dialect;
}

} // namespace

std::shared_ptr<ProjectFile> readFile(const OpenedFile &file, const std::shared_ptr<const OpenTexts> &open) {
  std::shared_ptr<const Dialect> chosen = dialectOf(file);
  const Dialect &dialect = *chosen;
  SyntaxTree tree = parse(file.source, dialect);
  ProgramModel model = resolve(file.source, tree, dialect);
  std::vector<Sidecar> sidecars = sidecarsOf(file.path, model, open);
  FileContracts contracts = readContracts(file.source, tree, model, dialect, sidecars);
  return std::make_shared<ProjectFile>(ProjectFile{file.shown, file.path, file.source, std::move(chosen),
                                                   std::move(tree), std::move(model), std::move(contracts),
                                                   std::move(sidecars)});
}

std::shared_ptr<ProjectFile> unreadFile(const OpenedFile &file) {
  return std::make_shared<ProjectFile>(ProjectFile{file.shown,
                                                   file.path,
                                                   file.source,
                                                   file.dialect,
                                                   parse(SourceFile::fromText("", ""), *file.dialect),
                                                   {},
                                                   {},
                                                   {}});
}

} // namespace feedhold
