#include "findings/project/project_file.h"

#include "language/parse/parse.h"

namespace feedhold {

std::shared_ptr<const ProjectFile> readFile(const OpenedFile &file, const std::shared_ptr<const OpenTexts> &open) {
  const Dialect &dialect = *file.dialect;
  SyntaxTree tree = parse(file.source, dialect);
  ProgramModel model = resolve(file.source, tree, dialect);
  std::vector<Sidecar> sidecars = sidecarsOf(file.path, model, open);
  FileContracts contracts = readContracts(file.source, tree, model, dialect, sidecars);
  return std::make_shared<const ProjectFile>(ProjectFile{file.shown, file.path, file.source, file.dialect,
                                                         std::move(tree), std::move(model), std::move(contracts),
                                                         std::move(sidecars)});
}

std::shared_ptr<const ProjectFile> unreadFile(const OpenedFile &file) {
  return std::make_shared<const ProjectFile>(ProjectFile{file.shown,
                                                         file.path,
                                                         file.source,
                                                         file.dialect,
                                                         parse(SourceFile::fromText("", ""), *file.dialect),
                                                         {},
                                                         {},
                                                         {}});
}

} // namespace feedhold
