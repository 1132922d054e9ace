// The section of a release report on one program.
#include "base/support/text.h"
#include "surface/report/report_html.h"

#include <algorithm>
#include <array>
#include <map>

namespace feedhold::certificate {

namespace {

constexpr std::size_t kLargestPicture = 400'000; // bytes of one in the page; a larger one lies beside it

/// Rows that say one thing, as they come.
struct Group {
  std::string title; // html
  std::vector<const Json *> rows;
};
template <typename Title> void addTo(std::vector<Group> &groups, const Json &row, const Title &title) {
  const auto at = std::find_if(groups.begin(), groups.end(), [&](const Group &group) { return group.title == title; });
  if (at == groups.end())
    groups.push_back({title, {&row}});
  else
    at->rows.push_back(&row);
}

/// `alarm 120 (NO FEATURE)`
std::string nameOfAlarm(const Json &alarm) {
  const std::string name =
      alarm.at("number").is_null() ? "An alarm of a computed number" : "Alarm " + number(alarm.at("number"));
  return alarm.at("message") == "" ? name : fmt::format("{} ({})", name, text(alarm.at("message")));
}

std::string claimOf(const Json &row) {
  return row.at("alarm").is_null() ? prose(row.at("claim")) : nameOfAlarm(row.at("alarm")) + " can be raised";
}

std::string guard(const Json &row) {
  return row.at("guard").is_null() ? std::string()
                                   : fmt::format("<p class=\"remedy\">With <code>{}</code> in the contract, it is "
                                                 "proved.</p>\n",
                                                 text(row.at("guard")));
}

class Section {
public:
  Section(const Json &file, const Json &program, const ShownPaths &paths, const Bundle &report, bool &isStyled)
      : file_(file), program_(program), paths_(paths), report_(report), isStyled_(isStyled) {}

  std::string write() {
    const Look look = lookOfStatus(program_.at("status"));
    add("<section class=\"program\" id=\"{}\">\n<h2>{} <small>{}</small></h2>\n<p class=\"meta\">{}, line {} &middot; "
        "control: {}</p>\n<p class=\"sentence {}\">{}</p>\n",
        anchorOf(file_, program_), text(program_.at("name")), text(program_.at("title")), paths_.of(file_.at("path")),
        number(program_.at("line")), text(file_.at("control")), look.style, prose(program_.at("summary")));
    if (!program_.at("incomplete").is_null())
      add("<p class=\"warning\">Not all paths were explored: {}.</p>\n", prose(program_.at("incomplete")));
    refutations();
    alarms();
    for (const Json &run : program_.at("runs"))
      picture(run);
    contract();
    calls();
    claims();
    add("</section>\n");
    return std::move(html_);
  }

private:
  template <typename... Arguments> void add(fmt::format_string<Arguments...> format, Arguments &&...arguments) {
    html_ += fmt::format(format, std::forward<Arguments>(arguments)...);
  }

  // ---- what is wrong ----

  /// One call may break many claims, and one claim at many lines.
  void refutations() {
    std::vector<Group> calls;
    for (const Json &row : program_.at("obligations"))
      if (row.at("verdict") == "refuted" && row.at("alarm").is_null() && !row.at("witness").is_null())
        addTo(calls, row, text(row.at("witness").at("run")));
    if (calls.empty())
      return;
    add("<h3>Calls that break a claim</h3>\n<p><small>Each was run and broke its claim. Run the command in the folder "
        "of this report to reproduce it; <code>plot</code> in place of <code>run</code> draws the tool "
        "path.</small></p>\n");
    for (const Group &call : calls) {
      add("<div class=\"witness\">\n<p class=\"call\"><code>{}</code></p>\n",
          text(call.rows.front()->at("witness").at("call")));
      std::vector<Group> messages;
      for (const Json *row : call.rows)
        addTo(messages, *row, prose(row->at("message")));
      for (const Group &message : messages) {
        add("<p><b>{}</b></p>\n<ul>\n", message.title);
        for (const Json *row : message.rows)
          add("<li>line {}: {} <small class=\"id\">{}</small></li>\n", number(row->at("line")),
              prose(row->at("witness").at("happened")), text(row->at("id")));
        add("</ul>\n{}", guard(*message.rows.front()));
      }
      add("<pre>{}</pre>\n</div>\n", call.title);
    }
  }

  void alarms() {
    std::vector<const Json *> raised;
    for (const Json &row : program_.at("obligations"))
      if (!row.at("alarm").is_null())
        raised.push_back(&row);
    if (!raised.empty())
      add("<h3>Alarms to decide on</h3>\n<p>The program raises these alarms for calls that the contract allows. "
          "That may be intended or a mistake; the contract has to say which.</p>\n");
    for (const Json *row : raised)
      openAlarm(*row);
  }
  void openAlarm(const Json &row) {
    const Json &alarm = row.at("alarm");
    add("<div class=\"witness alarm\">\n<p><b>{} can be raised</b>, line {} <small class=\"id\">{}</small></p>\n",
        nameOfAlarm(alarm), number(row.at("line")), text(row.at("id")));
    if (!row.at("witness").is_null())
      add("<p>For example, it is raised for <code>{}</code></p>\n", text(row.at("witness").at("call")));
    add("<ul>\n");
    add("<li>If it is intended, add <code>@ALARM {} IFF ...</code> to the contract, with the condition that "
        "raises it.</li>\n",
        alarm.at("number").is_null() ? std::string("n") : number(alarm.at("number")));
    if (row.at("guard").is_null())
      add("<li>If callers rule it out, add <code>@REQUIRE ...</code> to the contract, with what they "
          "guarantee.</li>\n");
    else
      add("<li>If callers rule it out, add <code>{}</code> to the contract. With this clause, the claim is "
          "proved.</li>\n",
          text(row.at("guard")));
    add("</ul>\n");
    if (!row.at("witness").is_null())
      add("<pre>{}</pre>\n", text(row.at("witness").at("run")));
    add("</div>\n");
  }

  void picture(const Json &run) {
    const std::string name = run.at("picture").at("file");
    const auto svg = report_.find(name);
    add("<figure>\n");
    if (svg != report_.end() && svg->second.size() <= kLargestPicture)
      html_ += withoutStyle(svg->second);
    else
      add("<p>The picture is large: <a href=\"{0}\">{0}</a></p>\n", xml(name));
    if (run.at("witnessOf").is_null())
      add("<figcaption>One call that the contract allows: <code>{}</code>. The proof covers all of them.",
          text(run.at("call")));
    else
      add("<figcaption>The call that breaks {}: <code>{}</code>", text(run.at("witnessOf")), text(run.at("call")));
    for (const Json &note : run.at("notes"))
      add(" {}.", prose(note));
    add("</figcaption>\n</figure>\n");
  }
  /// One style is enough for all pictures.
  std::string withoutStyle(const std::string &svg) {
    const std::size_t begin = svg.find("<style>"), end = svg.find("</style>");
    if (begin == std::string::npos || end == std::string::npos || !std::exchange(isStyled_, true))
      return svg;
    return svg.substr(0, begin) + svg.substr(end + 8);
  }

  // ---- what it is ----

  void contract() {
    add("<h3>Contract</h3>\n");
    if (program_.at("clauses").empty()) {
      add("<p>It has no contract. What is proved holds for every input.</p>\n");
      return;
    }
    add("<ul class=\"clauses\">\n");
    for (const Json &clause : program_.at("clauses"))
      add("<li><code>{}</code> <small>{}line {}</small></li>\n", text(clause.at("text")),
          clause.at("path") == file_.at("path") ? std::string() : paths_.of(clause.at("path")) + ", ",
          number(clause.at("line")));
    add("</ul>\n");
  }

  /// Those in its own text; the drawing has all to which they lead.
  void calls() {
    std::vector<Group> callees;
    for (const Json &call : program_.at("calls"))
      if (call.at("fromPath") == file_.at("path") && call.at("from") == program_.at("name"))
        addTo(callees, call,
              fmt::format("<b>{}</b> <small>{}", text(call.at("to")),
                          call.at("path").is_null() ? std::string("not supplied: it may do anything")
                                                    : paths_.of(call.at("path"))));
    if (callees.empty())
      return;
    add("<h3>Calls</h3>\n<ul class=\"calls\">\n");
    for (const Group &callee : callees) {
      add("<li>{}, line{} ", callee.title, callee.rows.size() == 1 ? "" : "s");
      for (std::size_t i = 0; i < callee.rows.size(); ++i)
        add("{}{}", i == 0 ? "" : ", ", number(callee.rows[i]->at("line")));
      add("</small></li>\n");
    }
    add("</ul>\n");
  }

  // ---- claims ----

  void claims() {
    if (program_.at("obligations").empty())
      return;
    add("<h3>Claims</h3>\n<table class=\"claims\">\n<thead><tr><th>Verdict</th><th class=\"n\">Line</th><th>Claim</th>"
        "<th>How</th><th class=\"n\">Work</th><th>Evidence</th>"
        "</tr></thead>\n");
    constexpr std::array kOrder = {"refuted", "alarm", "unknown", "alarm as said", "proved", "unreachable"};
    for (const std::string_view word : kOrder) {
      std::vector<Group> groups;
      for (const Json &row : program_.at("obligations"))
        if (lookOfClaim(row).word == word)
          addTo(groups, row, claimOf(row));
      for (const Group &group : groups)
        claim(group);
    }
    add("</table>\n");
  }
  /// A claim once, and the lines at which it is made.
  void claim(const Group &group) {
    const Look look = lookOfClaim(*group.rows.front());
    const bool isOne = group.rows.size() == 1;
    add("<tbody>\n");
    if (!isOne)
      add("<tr class=\"many\"><td>{}</td><td></td><td colspan=\"4\">{} <small>at {} places</small></td></tr>\n",
          badge(look), group.title, group.rows.size());
    for (const Json *row : group.rows) {
      add("<tr{}><td>{}</td><td class=\"n\">{}</td><td>{}<small class=\"id\">{}{}</small>{}</td>",
          isOne ? "" : " class=\"one\"",
          isOne ? badge(look) : fmt::format("<span class=\"{}\">{}</span>", look.style, look.sign),
          number(row->at("line")), isOne ? group.title + "<br>" : std::string(), text(row->at("id")),
          row->at("path") == file_.at("path") ? std::string() : ", " + paths_.of(row->at("path")), remarks(*row));
      add("<td>{}{}</td><td class=\"n\">{}</td><td>{}</td></tr>\n",
          row->at("grade").is_null() ? std::string() : text(row->at("grade")),
          row->at("method").is_null() ? std::string() : fmt::format(" <small>{}</small>", text(row->at("method"))),
          row->at("method").is_null() ? std::string() : number(row->at("effort")), evidence(row->at("evidence")));
    }
    add("</tbody>\n");
  }
  static std::string remarks(const Json &row) {
    std::string html;
    const auto remark = [&](const std::string &words) { html += fmt::format("<br><small>{}</small>", words); };
    if (!row.at("reason").is_null())
      remark(prose(row.at("reason")));
    if (!row.at("bound").is_null())
      remark(fmt::format("at most <code>{}</code> iterations", text(row.at("bound"))));
    if (!row.at("margin").is_null())
      html += fmt::format(" <small>margin {}</small>", decimalText(row.at("margin").get<double>(), 6));
    if (row.at("exactOnly") == true)
      html += fmt::format("<br><small class=\"caution\">{}</small>", kExactOnly);
    if (row.at("verdict") == "unknown" && !row.at("guard").is_null())
      remark(fmt::format("with <code>{}</code> in the contract, it is proved", text(row.at("guard"))));
    return html;
  }
  /// Links to the files of the first part: the others lie beside them.  On paper the number of the folder will do.
  static std::string evidence(const Json &row) {
    if (row.is_null())
      return {};
    const std::uint64_t parts = row.at("queries").get<std::uint64_t>() + row.at("certificates").get<std::uint64_t>();
    std::string links;
    for (const Json &file : row.at("first")) {
      const std::string &name = file.get_ref<const std::string &>();
      links += fmt::format("{}<a href=\"{}\">{}</a>", links.empty() ? "" : ", ", xml(name),
                           row.at("first").size() == 1      ? "question"
                           : name.ends_with(".certificate") ? "certificate"
                                                            : "claim");
    }
    const std::string first = row.at("first").front();
    const std::string folder = first.substr(kEvidenceFolder.size(), first.rfind('/') - kEvidenceFolder.size());
    return fmt::format("<span class=\"screen\">{}{}</span><span class=\"paper\">{}</span>", links,
                       parts > 1 ? fmt::format(" <small>and {} more</small>", parts - 1) : std::string(),
                       xml(folder.substr(0, folder.find('-'))));
  }

  const Json &file_;
  const Json &program_;
  const ShownPaths &paths_;
  const Bundle &report_;
  bool &isStyled_;
  std::string html_;
};

} // namespace

std::string programOf(const Json &file, const Json &program, const ShownPaths &paths, const Bundle &report,
                      bool &isStyled) {
  return Section(file, program, paths, report, isStyled).write();
}

} // namespace feedhold::certificate
