// Any bytes through lexer, parser, model, flow and rules: the first byte picks the dialect, the rest is the program.
#include "base/support/check.h"
#include "dialects/registry.h"
#include "findings/rule/run_rules.h"
#include "findings/rule/suppression.h"
#include "language/parse/parse.h"
#include "meaning/cfg/program_set.h"
#include "rules/registry.h"

#include <vector>

namespace {

using namespace feedhold;

const std::vector<const Rule *> &everyRule() {
  static const std::vector<const Rule *> rules = [] {
    std::vector<const Rule *> all;
    for (const RegisteredRule &registered : allRules().rules)
      all.push_back(registered.rule);
    return all;
  }();
  return rules;
}

void run(std::string text, const Dialect &dialect) {
  const SourceFile source = SourceFile::fromText("fuzz.nc", std::move(text));
  const SyntaxTree tree = parse(source, dialect);
  FEEDHOLD_CHECK(print(tree, source) == source.text(), "the tree lost text");
  const ProgramModel model = resolve(source, tree, dialect);
  FEEDHOLD_CHECK(dump(tree, source).size() + dump(model, tree, source).size() > 0, "a dump is empty");
  const CallGraph graph({{FileId(0), "", "fuzz", &model}});
  const std::vector<Sidecar> sidecars = {{source, std::nullopt}}; // the same lines as a file beside the program
  const FileContracts read = readContracts(source, tree, model, dialect, sidecars);
  const std::vector<const FileContracts *> contracts = {&read};
  FEEDHOLD_CHECK(dump(read, model, tree).empty() == read.contracts.empty(), "a contract is lost");
  const ProgramSet programs({{FileId(0), &source, &tree, &model, &dialect}}, graph);
  const FileContext context{FileId(0), source, dialect, tree, model, graph, &programs, contracts};
  for (const RawFinding &finding :
       applySuppressions(runRules(everyRule(), context), context, allRules(), everyRule()).kept)
    FEEDHOLD_CHECK(finding.diagnostic.span.end <= source.text().size(), "a finding outside of the text");
  FileContext beside = context;
  beside.contractSource = ContractSourceId(1);
  for (const RawFinding &finding : runContractRules(everyRule(), beside))
    FEEDHOLD_CHECK(finding.diagnostic.span.end <= source.text().size(), "a finding outside of a contract");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  if (size == 0)
    return 0;
  const auto dialects = feedhold::allDialects().dialects;
  run(std::string(reinterpret_cast<const char *>(data + 1), size - 1), *dialects[data[0] % dialects.size()]);
  return 0;
}
