// A run for programs; its shape is docs/schemas/run.schema.json.  A movement a line: there may be a million.
#include "surface/sink/json_parts.h"
#include "surface/sink/run_shown.h"

#include <nlohmann/json.hpp>

namespace feedhold {

namespace {

using json::Json;

Json placeOf(const RunReport &report, Place place) {
  const ProgramFile &file = report.programs.file(place.file);
  return {{"file", report.shown[place.file.index()]},
          {"program", programAt(report, place.file, file.model->programOf(blockAt(report, place)))},
          {"line", lineAt(report, place)}};
}

Json alarmOf(const RunReport &report) {
  const RunResult &result = report.result;
  if (result.end != RunEnd::Alarm && result.end != RunEnd::UserAlarm)
    return nullptr;
  const ProgramFile &file = report.programs.file(result.place.file);
  Json alarm;
  if (result.end == RunEnd::Alarm) {
    const auto number = alarmNumber(*file.dialect, result.alarm);
    alarm = {{"by", "control"}, {"number", number ? Json(*number) : Json()}, {"message", meaningOf(result.alarm)}};
  } else {
    alarm = {{"by", "program"}, {"number", result.alarmNumber}, {"message", result.alarmText}};
  }
  alarm.update(placeOf(report, result.place));
  const Position begin = file.source->position(result.alarmSpan.begin);
  alarm["line"] = begin.line;
  alarm["column"] = begin.column;
  return alarm;
}

Json variablesToJson(const RunReport &report) {
  Json variables = Json::object();
  for (const auto &[name, value] : variablesOf(report))
    variables[name.substr(1)] = value.vacant ? Json() : Json(value.number);
  return variables;
}

Json pointOf(const std::array<ConcreteValue, kAxisCount> &point, const std::vector<Axis> &axes) {
  Json coordinates;
  for (const Axis axis : axes)
    coordinates[std::string(1, letterOf(axis))] = point[indexOf(axis)].number;
  return coordinates;
}

void addPath(Json &row, const Move<ConcreteValue> &move, const std::vector<Axis> &axes) {
  row["from"] = pointOf(move.start, axes);
  row["to"] = pointOf(move.end, axes);
  if (!isArc(move.kind))
    return;
  row["centre"] = {{std::string(1, letterOf(move.plane.first)), move.firstCentre.number},
                   {std::string(1, letterOf(move.plane.second)), move.secondCentre.number}};
  row["turns"] = move.turns;
}

Json moveToJson(const RunReport &report, const RecordedMove &recorded, const std::vector<Axis> &axes) {
  const Move<ConcreteValue> &move = recorded.move;
  Json row = {{"kind", nameOf(move.kind)},
              {"file", report.shown[recorded.place.file.index()]},
              {"line", lineAt(report, recorded.place)}};
  const Json feed = move.feed.vacant ? Json() : Json(move.feed.number);
  if (move.kind == MoveKind::Dwell) {
    row["time"] = feed;
    return row;
  }
  row["units"] = recorded.unit == LengthUnit::Inch ? "inch" : "mm";
  addPath(row, move, axes);
  if (move.kind != MoveKind::Rapid)
    row["feed"] = feed;
  for (const Move<ConcreteValue> &step : recorded.centre) {
    Json way = {{"kind", nameOf(step.kind)}};
    addPath(way, step, axes);
    row["toolPath"].push_back(std::move(way));
  }
  return row;
}

/// One value a line.
template <typename Items, typename ToJson> std::string listOf(const Items &items, ToJson toJson) {
  std::string text;
  for (const auto &item : items)
    text += (text.empty() ? "\n    " : ",\n    ") + json::compactText(toJson(item));
  return "[" + text + (text.empty() ? "]" : "\n  ]");
}

} // namespace

std::string writeRunJson(const RunReport &report) {
  const RunResult &result = report.result;
  const std::vector<Axis> axes = axesOf(report);
  std::string text = "{\n  \"version\": 2";
  const auto member = [&](std::string_view name, const std::string &value) {
    text += ",\n  \"" + std::string(name) + "\": " + value;
  };
  const Json start = {{"file", report.shown[report.start.file.index()]},
                      {"program", programAt(report, report.start.file, report.start.program)}};
  member("start", json::compactText(start));
  member("numbers", json::compactText(nameOf(report.numbers)));
  member("end", json::compactText(nameOf(result.end)));
  member("place", json::compactText(placeOf(report, result.place)));
  member("alarm", json::compactText(alarmOf(report)));
  member("calls", listOf(result.calls, [&](const OpenCall &call) { return placeOf(report, call.place); }));
  member("steps", std::to_string(result.steps));
  member("variables", json::compactText(variablesToJson(report)));
  member("notes", listOf(result.notes, [&](const RunNote &note) {
           Json row = {{"reason", note.reason}};
           row.update(placeOf(report, note.place));
           return row;
         }));
  if (result.offsetIsAssumed)
    member("offsetFromTool", "true");
  member("skipped", json::compactText(result.skipped));
  member("moves", listOf(result.moves, [&](const RecordedMove &move) { return moveToJson(report, move, axes); }));
  if (!report.trace.empty())
    member("trace", listOf(report.trace, [&](const TracedBlock &block) {
             return Json{{"file", report.shown[block.place.file.index()]},
                         {"line", lineAt(report, block.place)},
                         {"depth", block.depth}};
           }));
  return text + "\n}\n";
}

} // namespace feedhold
