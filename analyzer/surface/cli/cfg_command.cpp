// `feedhold cfg FILE`: the control-flow graph of each program of a file.
#include "language/parse/parse.h"
#include "meaning/cfg/cfg.h"
#include "surface/cli/dump_input.h"

namespace feedhold {

namespace {

std::string dumpCfg(const SourceFile &source, const Dialect &dialect) {
  const SyntaxTree tree = parse(source, dialect);
  const ProgramModel model = resolve(source, tree, dialect);
  return dump(lower(source, tree, model, dialect), tree, source, model);
}

} // namespace

Command addCfgCommand(CLI::App &parent) {
  return addDumpCommand(parent, "cfg", "print the control-flow graph of a program", dumpCfg);
}

} // namespace feedhold
