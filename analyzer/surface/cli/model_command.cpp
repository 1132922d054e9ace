// `feedhold model FILE`: what the names of a file mean: programs, labels, jumps, loops, calls, variables.
#include "language/model/model.h"
#include "language/parse/parse.h"
#include "surface/cli/dump_input.h"

namespace feedhold {

namespace {

std::string dumpModel(const SourceFile &source, const Dialect &dialect) {
  const SyntaxTree tree = parse(source, dialect);
  return dump(resolve(source, tree, dialect), tree, source);
}

} // namespace

Command addModelCommand(CLI::App &parent) {
  return addDumpCommand(parent, "model", "print programs, jumps, loops, calls and variables of a file", dumpModel);
}

} // namespace feedhold
