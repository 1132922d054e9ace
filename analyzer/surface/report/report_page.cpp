// The page of a release report: one HTML file without script, without network, made of certificate.json and the
// pictures beside it alone, so that it can be made again and compared.
#include "base/support/sha256.h"
#include "surface/report/report_html.h"
#include "surface/report/report_style.h"

#include <array>
#include <map>
#include <set>

namespace feedhold::certificate {

namespace {

constexpr std::size_t kMostOnFirstPage = 5; // programs whose summary surely leaves room for the boxes for signatures
constexpr std::size_t kMostHashed = 4;      // programs whose hashes stand there, too
constexpr std::size_t kMostNamed = 12;      // programs in a line of the verdict

/// How many claims are shown as what: by the word of their look.
using Counts = std::map<std::string_view, std::size_t>;
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kCounted = {
    std::pair{"refuted", "refuted"},
    {"alarm", "alarms to decide on"},
    {"unknown", "unknown"},
    {"alarm as said", "alarms as the contract says"},
    {"proved", "proved"},
    {"unreachable", "unreachable"},
};

void countInto(Counts &counts, const Json &program) {
  for (const Json &row : program.at("obligations"))
    ++counts[lookOfClaim(row).word];
}

class Page {
public:
  Page(const std::string &certificate, const Bundle &report)
      : document_(Json::parse(certificate)), sha256_(sha256(certificate)), report_(report), paths_(document_) {
    for (const Json &file : document_.at("files"))
      programs_ += file.at("programs").size();
    for (const Json &source : document_.at("sources"))
      shaOf_[source.at("path")] = source.at("sha256");
  }

  std::string write() {
    head();
    verdict();
    if (programs_ > kMostOnFirstPage)
      signOff();
    summary();
    if (programs_ <= kMostOnFirstPage)
      signOff();
    html_ += callsOf(document_);
    bool isStyled = false;
    for (const Json &file : document_.at("files"))
      for (const Json &program : file.at("programs"))
        html_ += programOf(file, program, paths_, report_, isStyled);
    notChecked();
    findings();
    assumptions();
    identity();
    disclaimer();
    html_ += "</main>\n</body>\n</html>\n";
    return std::move(html_);
  }

private:
  template <typename... Arguments> void add(fmt::format_string<Arguments...> format, Arguments &&...arguments) {
    html_ += fmt::format(format, std::forward<Arguments>(arguments)...);
  }
  template <typename Visit> void eachProgram(const Visit &visit) const {
    for (const Json &file : document_.at("files"))
      for (const Json &program : file.at("programs"))
        visit(file, program);
  }

  // ---- what who signs has to see: on paper it is the first page ----

  void head() {
    std::string name = fmt::format("{} programs", programs_);
    if (programs_ == 1)
      eachProgram([&](const Json &, const Json &program) { name = program.at("name"); });
    add("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"generator\" content=\"feedhold {}\">\n"
        "<meta name=\"certificate-sha256\" content=\"{}\">\n"
        "<title>Release report: {}</title>\n<style>\n{}@page {{ @bottom-left {{ content: \"release report {}\"; }} }}\n"
        "</style>\n</head>\n<body>\n<main>\n",
        text(document_.at("feedhold")), sha256_, xml(name), kPageStyle, sha256_.substr(0, 16));
    add("<header>\n<p class=\"kind\">Release report</p>\n<h1>{}</h1>\n<p class=\"meta\">{}feedhold {}", xml(name),
        document_.at("date").is_null() ? std::string() : text(document_.at("date")) + " &middot; ",
        text(document_.at("feedhold")));
    for (const Json &solver : document_.at("solvers"))
      add(" &middot; {}", text(solver));
    add("</p>\n<p class=\"meta\">certificate.json, SHA-256 <span class=\"hash\">{}</span></p>\n", sha256_);
    if (!paths_.folder().empty())
      add("<p class=\"meta\">Programs in <span class=\"path\">{}</span>, as seen from this report</p>\n",
          xml(paths_.folder()));
    add("</header>\n");
  }

  void verdict() {
    const Look look = lookOfStatus(document_.at("status"));
    const Json &status = document_.at("status");
    const std::string_view words = status == "ready"     ? "Ready for release: every claim is proved"
                                   : status == "refuted" ? "Not fit for release: claims are refuted"
                                   : status == "alarms"
                                       ? "Decide before release: the contracts do not settle some alarms"
                                       : "Not ready for release: some claims are not proved";
    Counts counts;
    eachProgram([&](const Json &, const Json &program) { countInto(counts, program); });
    std::size_t all = 0;
    for (const auto &[word, count] : counts)
      all += count;
    add("<section class=\"verdict {}\">\n<p class=\"sign\" aria-hidden=\"true\">{}</p>\n<div>\n<h2>{}</h2>\n<p>{} on "
        "{}:",
        look.style, look.sign, words, counted(all, "claim"), counted(programs_, "program"));
    std::string_view between = " ";
    for (const auto &[word, shown] : kCounted)
      if (counts[word] != 0)
        add("{}<span class=\"count\">{}</span> {}", std::exchange(between, ", "), counts[word],
            counts[word] == 1 && shown.starts_with("alarms") ? "alarm" + std::string(shown.substr(6))
                                                             : std::string(shown));
    add("</p>\n");
    if (programs_ > 1)
      for (const char *each : {"refuted", "alarms", "open", "ready"})
        named(each);
    if (counts["refuted"] != 0)
      add("<p>Refuted: Feedhold found a call that breaks the claim, and ran it. Change the program or its "
          "contract.</p>\n");
    if (counts["alarm"] != 0)
      add("<p>An alarm to decide on: the program raises it for a call that the contract allows. If that is "
          "intended, declare it with <code>@ALARM</code>. If not, rule the call out with <code>@REQUIRE</code>.</p>\n");
    if (counts["unknown"] != 0)
      add("<p>Unknown: Feedhold found neither a proof nor a counterexample.</p>\n");
    add("<p>Proved: the claim holds for all inputs, in exact arithmetic and under the "
        "<a href=\"#assumptions\">assumptions</a> in this report. The control rounds: <code>feedhold prove</code> "
        "says which claims hold for its rounded numbers, too. See also what was <a href=\"#not-checked\">not "
        "checked</a>.</p>\n</div>\n</section>\n");
  }
  /// `Refuted: O9313, O9314 and 3 more`
  void named(std::string_view status) {
    std::size_t count = 0;
    std::string names;
    eachProgram([&](const Json &file, const Json &program) {
      if (program.at("status") == status && ++count <= kMostNamed)
        names += fmt::format("{}<a href=\"#{}\">{}</a>", count == 1 ? "" : ", ", anchorOf(file, program),
                             text(program.at("name")));
    });
    if (count == 0)
      return;
    const Look look = lookOfStatus(Json(status));
    add("<p class=\"named\">{} {}: {}{}</p>\n", badge(look), counted(count, "program"), names,
        count > kMostNamed ? fmt::format(" and {} more", count - kMostNamed) : std::string());
  }

  void summary() {
    add("<section id=\"summary\">\n<h2>Summary</h2>\n<table class=\"summary\">\n<thead><tr><th>Program</th>"
        "<th>Result</th><th class=\"n\">Proved</th><th class=\"n\">Refuted</th><th class=\"n\">Alarms</th>"
        "<th class=\"n\">Unknown</th><th class=\"n\" title=\"no run reaches the block\">Unreach&shy;able</th></tr>"
        "</thead>\n<tbody>\n");
    eachProgram([&](const Json &file, const Json &program) {
      Counts counts;
      countInto(counts, program);
      const auto cell = [](std::size_t count, std::string_view style) {
        return fmt::format("<td class=\"n {}\">{}</td>", count == 0 ? "none" : style, count);
      };
      const std::size_t open = counts["alarm"], said = counts["alarm as said"];
      add("<tr><td><a class=\"name\" href=\"#{}\">{}</a><br><small class=\"path\">{}</small></td><td>{}{}{}</td>"
          "{}{}{}{}{}</tr>\n",
          anchorOf(file, program), text(program.at("name")), paths_.of(file.at("path")),
          program.at("title") == ""
              ? std::string()
              : fmt::format("<b>{}</b><span class=\"paper\">. </span><br class=\"screen\">", text(program.at("title"))),
          prose(program.at("summary")), hashOf(file), cell(counts["proved"], "proved"),
          cell(counts["refuted"], "refuted"), cell(open + said, open == 0 ? "proved" : "alarms"),
          cell(counts["unknown"], "unknown"), cell(counts["unreachable"], "unreachable"));
    });
    add("</tbody>\n</table>\n</section>\n");
  }
  std::string hashOf(const Json &file) const {
    const auto sha = shaOf_.find(file.at("path"));
    return programs_ > kMostHashed || sha == shaOf_.end()
               ? std::string()
               : fmt::format("<br><small class=\"hash\" title=\"SHA-256\">{}</small>", sha->second);
  }

  void signOff() {
    add("<section id=\"sign-off\">\n<h2>Sign-off</h2>\n<p>Whoever signs has read the summary, the assumptions, the "
        "findings and what was not checked.</p>\n<table "
        "class=\"sign-off\">\n<thead><tr><th></th><th>Name</th><th>Date</th>"
        "<th>Signature</th></tr></thead>\n<tbody>\n");
    for (const char *role : {"Author", "Checker", "Approver"})
      add("<tr><th>{}</th><td></td><td></td><td></td></tr>\n", role);
    add("</tbody>\n</table>\n</section>\n");
  }

  // ---- behind the programs ----

  void notChecked() {
    add("<section id=\"not-checked\">\n<h2>What was not checked</h2>\n<ul>\n");
    std::size_t count = 0;
    const auto item = [&](const std::string &line) {
      add("<li>{}</li>\n", line);
      ++count;
    };
    if (!document_.at("options").at("only").empty()) {
      std::string kinds;
      for (const Json &kind : document_.at("options").at("only"))
        kinds += (kinds.empty() ? "" : ", ") + text(kind);
      item("All kinds of claims except these: " + kinds);
    }
    for (const Json &skipped : document_.at("skipped"))
      item(fmt::format("{}: {}", paths_.of(skipped.at("path")), prose(skipped.at("reason"))));
    for (const Json &file : document_.at("files"))
      for (const Json &program : file.at("programs"))
        unmodelled(file, program, item);
    if (count == 0)
      item("Nothing was left out: all files were read, all called programs found, all blocks modelled.");
    add("</ul>\n</section>\n");
  }
  template <typename Item> void unmodelled(const Json &file, const Json &program, const Item &item) const {
    const std::string name = fmt::format("<a href=\"#{}\">{}</a>", anchorOf(file, program), text(program.at("name")));
    if (!program.at("incomplete").is_null())
      item(fmt::format("{}: not all paths were explored: {}", name, prose(program.at("incomplete"))));
    std::set<std::string> told;
    for (const Json &each : program.at("unmodelled"))
      if (const std::string line =
              fmt::format("{}: {} line {}: not modelled, so anything may happen there: {}", name,
                          paths_.of(each.at("path")), number(each.at("line")), prose(each.at("reason")));
          told.insert(line).second)
        item(line);
  }

  void findings() {
    add("<section id=\"findings\">\n<h2>Findings of <code>feedhold check</code></h2>\n");
    std::size_t count = 0;
    for (const Json &file : document_.at("files"))
      for (const Json &finding : file.at("findings")) {
        if (count++ == 0)
          add("<table>\n<thead><tr><th>Place</th><th>Finding</th><th>Rule</th></tr></thead>\n<tbody>\n");
        add("<tr{}><td>{}:{}</td><td>{}{}</td><td>{}<br><small>{}</small></td></tr>\n",
            finding.at("suppressed") == true ? " class=\"suppressed\"" : "", paths_.of(file.at("path")),
            number(finding.at("line")), prose(finding.at("message")),
            finding.at("suppressed") == true
                ? fmt::format("<br><small>allowed by the program: {}</small>", reasonOf(finding))
                : std::string(),
            text(finding.at("rule")), text(finding.at("severity")));
      }
    add("{}</section>\n", count == 0 ? "<p>None.</p>\n" : "</tbody>\n</table>\n");
  }
  static std::string reasonOf(const Json &finding) {
    return finding.at("reason").is_null() ? std::string("no reason is given") : text(finding.at("reason"));
  }

  void assumptions() {
    add("<section id=\"assumptions\">\n<h2>Assumptions</h2>\n<p>What the proofs assume, and who is responsible for "
        "it.</p>\n<table>\n<thead><tr><th></th><th>Assumption</th><th>Responsible</th><th>Claims that depend on "
        "it</th>"
        "</tr></thead>\n<tbody>\n");
    for (const Json &row : document_.at("assumptions"))
      add("<tr id=\"{0}\"><td class=\"name\">{0}</td><td><b>{1}.</b> {2}</td><td>{3}</td><td>{4}</td></tr>\n",
          text(row.at("id")), text(row.at("title")), text(row.at("text")), text(row.at("responsible")),
          text(row.at("kinds")));
    add("</tbody>\n</table>\n</section>\n");
  }

  void identity() {
    add("<section id=\"identity\">\n<h2>Identity</h2>\n<p>The files that were read. Paths are relative to the folder "
        "of this "
        "report.</p>\n<table class=\"identity\">\n<thead><tr><th>File</th><th>Role</th><th class=\"n\">Bytes</th>"
        "<th>SHA-256</th></tr></thead>\n<tbody>\n");
    for (const Json &source : document_.at("sources")) {
      std::string roles;
      for (const Json &role : source.at("roles"))
        roles.append(roles.empty() ? "" : ", ").append(text(role)); // with `+`, GCC 12 warns of a length that cannot be
      add("<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"hash\">{}</td></tr>\n", text(source.at("path")),
          roles, number(source.at("bytes")), text(source.at("sha256")));
    }
    add("</tbody>\n</table>\n<h3>Control and switches</h3>\n<table>\n<thead><tr><th>Files</th><th>Control</th>"
        "<th>Chosen by</th><th>Switches that were changed</th></tr></thead>\n<tbody>\n");
    std::map<std::string, std::vector<std::string>> bySettings;
    for (const Json &file : document_.at("files"))
      bySettings[settings(file)].push_back(text(file.at("path")));
    for (const auto &[row, files] : bySettings)
      add("<tr><td>{}</td>{}</tr>\n",
          files.size() > 6 ? fmt::format("{} and {} more", files.front(), files.size() - 1)
                           : fmt::format("{}", fmt::join(files, "<br>")),
          row);
    add("</tbody>\n</table>\n");
    qualification();
    add("</section>\n");
  }
  /// Reports of earlier versions have none.
  void qualification() {
    if (!document_.contains("selfCheck"))
      return;
    add("<h3>Self-check of the program that made this report</h3>\n<table>\n<thead><tr><th>Step</th><th>Result</th>"
        "<th>What it shows</th></tr></thead>\n<tbody>\n");
    for (const Json &step : document_.at("selfCheck"))
      add("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", text(step.at("name")), text(step.at("result")),
          text(step.at("message")));
    add("</tbody>\n</table>\n");
  }
  static std::string settings(const Json &file) {
    std::string switches;
    for (const Json &each : file.at("switches"))
      if (each.at("chosenBy") != "dialect")
        switches += fmt::format("<code>{} = {}</code> ", text(each.at("name")), text(each.at("value")));
    std::string chosen = file.at("chosenBy").is_null() ? std::string() : text(file.at("chosenBy"));
    for (const Json &reason : file.at("reasons"))
      chosen += fmt::format("<br><small>{}</small>", prose(reason));
    if (!file.at("config").is_null())
      chosen += fmt::format("<br><small>configuration: {}</small>", text(file.at("config")));
    return fmt::format("<td>{}<br><small>{}</small></td><td>{}</td><td>{}</td>", text(file.at("control")),
                       text(file.at("dialect")), chosen, switches.empty() ? "none" : switches);
  }

  void disclaimer() {
    add("<section id=\"disclaimer\">\n<h2>What this report is not</h2>\n<p>An NC program is not a safety function, "
        "and neither is this report. It does not replace guards, limit switches or a first run with a hand on the feed "
        "hold button. It says nothing about fixtures, materials, cutting conditions or wear. It does not say that the "
        "part matches the drawing.</p>\n<h2>How to read the tables</h2>\n<p><b>Certified</b>: a small, solver-free "
        "checker "
        "verified each step of the proof in exact fractions. <b>Two-solvers</b>: two independent solvers, Z3 and cvc5, "
        "agree. <b>Margin</b>: the smallest distance of the tool from the boundary. <b>Work</b>: the cost of the proof "
        "in steps, the same in every run. <b>Evidence</b>: the files of the proof; on paper, the number of their "
        "folder "
        "in <code>{0}</code>.</p>\n<h2>How to check it</h2>\n<p><code>feedhold recheck FOLDER</code> compares all "
        "hashes, repeats every proof, verifies every certificate, and asks Z3 and cvc5 again.</p>\n</section>\n",
        kEvidenceFolder);
  }

  Json document_;
  std::string sha256_;
  const Bundle &report_;
  ShownPaths paths_;
  std::map<std::string, std::string> shaOf_; // of what was read, by path
  std::size_t programs_ = 0;
  std::string html_;
};

} // namespace

std::string pageOf(const std::string &certificate, const Bundle &report) { return Page(certificate, report).write(); }

} // namespace feedhold::certificate
