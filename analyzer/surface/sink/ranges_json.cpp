// Ranges for programs; their shape is docs/schemas/ranges.schema.json.  A block a line.
#include "base/support/text.h"
#include "inference/absint/describe.h"
#include "surface/sink/json_parts.h"
#include "surface/sink/ranges_facts.h"
#include "surface/sink/ranges_sink.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace feedhold {

namespace {

using json::Json;

class RangesJson {
public:
  explicit RangesJson(const RangesReport &report) : report_(report) {}

  std::string write() const {
    const BlockStates &states = report_.states;
    std::string text = "{\n  \"version\": 2";
    text += ",\n  \"line\": " + (report_.line ? std::to_string(*report_.line) : "null");
    text += ",\n  \"gaveUp\": " + json::compactText(states.gaveUp ? Json(*states.gaveUp) : Json());
    text += ",\n  \"complete\": " + std::string(states.isCutShort || states.gaveUp ? "false" : "true");
    text += ",\n  \"contexts\": [";
    bool isFirst = true;
    for (const ContextStates &context : states.contexts)
      if (!context.blocks.empty()) {
        text += (isFirst ? "\n    " : ",\n    ") + contextText(context);
        isFirst = false;
      }
    text += isFirst ? "]" : "\n  ]";
    Json notes = Json::array();
    for (const UnmodelledNote &note : states.unmodelled) {
      Json row = {{"reason", note.reason}};
      row.update(placeToJson(note.place));
      notes.push_back(std::move(row));
    }
    return text + ",\n  \"unmodelled\": " + json::compactText(notes) + "\n}\n";
  }

private:
  std::string contextText(const ContextStates &context) const {
    const ProgramFile &file = report_.programs.file(context.file);
    const FactsOfStates facts(context, report_.programs);
    Json calls = Json::array();
    for (const Place call : context.calls)
      calls.push_back(placeToJson(call));
    std::string text = "{\"start\": " + json::compactText(programToJson(context.start.file, context.start.program)) +
                       ", \"assumesContract\": " + json::compactText(context.assumesContract) +
                       ", \"calls\": " + json::compactText(calls) +
                       ", \"program\": " + json::compactText(programToJson(context.file, context.program)) +
                       ", \"blocks\": [";
    bool isFirst = true;
    for (const auto &[block, state] : context.blocks) {
      Json row = {{"line", file.source->lineOf(file.tree->blocks[block].begin)},
                  {"text", trimmed(file.source->utf8(file.tree->blocks[block].span()))}};
      row.update(factsToJson(facts.at(state.state())));
      text += (isFirst ? "\n      " : ",\n      ") + json::compactText(row);
      isFirst = false;
    }
    return text + "\n    ]}";
  }

  static Json factsToJson(const StateFacts &facts) {
    Json row = {{"variables", valuesToJson(facts.variables)}, {"positions", valuesToJson(facts.positions)}};
    row["otherVariablesUnknown"] = facts.othersAreUnknown;
    row["modes"] = Json::array();
    for (const ModeFact &fact : facts.modes)
      row["modes"].push_back({{"name", fact.name}, {"codes", fact.codes}, {"asAtStart", fact.maybeAsAtStart}});
    row["settings"] = valuesToJson(facts.settings);
    row["modalCalls"] = facts.modalCalls;
    row["otherModalCalls"] = facts.maybeOtherModalCalls;
    return row;
  }
  static Json valuesToJson(const std::vector<ValueFact> &facts) {
    Json rows = Json::array();
    for (const ValueFact &fact : facts) {
      Json row = {{"name", fact.name}, {"text", textOf(fact)}, {"vacant", vacancyOf(fact.value)}};
      if (fact.value.mayBeNumber())
        row["number"] = numberToJson(fact.value.number());
      if (fact.relation)
        row["equals"] = {{"name", fact.relation->name},
                         {"when", fact.relation->time == KnownRelation::Time::AtStart ? "start" : "now"},
                         {"plus", fact.relation->offset}};
      rows.push_back(std::move(row));
    }
    return rows;
  }
  static std::string_view vacancyOf(const AbstractValue &value) {
    if (value.isVacant())
      return "yes";
    return value.mayBeVacant() ? "maybe" : "no";
  }
  static Json numberToJson(const AbstractNumber &number) {
    const auto bound = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
    Json row = {{"min", bound(number.interval().lo)}, {"max", bound(number.interval().hi)}};
    if (!number.set().isMany())
      row["values"] = std::vector<double>(number.set().values().begin(), number.set().values().end());
    else if (!number.grid().isAny())
      row["grid"] = {{"step", number.grid().step().toDouble()}, {"from", number.grid().offset().toDouble()}};
    return row;
  }

  Json programToJson(FileId file, ProgramId program) const {
    return {{"file", report_.shown[file.index()]},
            {"program", toString(report_.programs.file(file).model->programs[program].name)}};
  }
  Json placeToJson(Place place) const {
    const ProgramFile &file = report_.programs.file(place.file);
    const BlockId block = file.cfg.nodes[place.node].block;
    Json row = programToJson(place.file, file.model->programOf(block));
    row["line"] = file.source->lineOf(file.tree->blocks[block].begin);
    return row;
  }

  const RangesReport &report_;
};

} // namespace

std::string writeRangesJson(const RangesReport &report) { return RangesJson(report).write(); }

} // namespace feedhold
