// The page of a certificate: one HTML file without script, without network, made of certificate.json and the pictures
// beside it alone, so that it can be made again and compared.
#include "base/support/sha256.h"
#include "surface/sink/certificate_parts.h"
#include "surface/sink/certificate_style.h"
#include "surface/sink/xml.h"

#include <fmt/format.h>

#include <set>

namespace feedhold::certificate {

namespace {

constexpr std::size_t kLargestPicture = 400'000; // bytes of one in the page; a larger one lies beside it

std::string text(const Json &value) { return xml(value.get<std::string>()); }

/// Code in backticks becomes code.
std::string prose(std::string_view words) {
  std::string html;
  bool isCode = false;
  while (!words.empty()) {
    const std::size_t tick = words.find('`');
    html += xml(words.substr(0, tick));
    if (tick == std::string_view::npos)
      break;
    html += isCode ? "</code>" : "<code>";
    isCode = !isCode;
    words.remove_prefix(tick + 1);
  }
  return html + (isCode ? "</code>" : "");
}
std::string prose(const Json &value) { return prose(std::string_view(value.get_ref<const std::string &>())); }

/// An anchor: plain letters and digits.
std::string anchor(std::string_view name) {
  std::string plain;
  for (const char c : name)
    plain +=
        (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' || c == '-' ? c : '_';
  return plain;
}

std::string number(const Json &value) {
  return value.is_number_float() ? fmt::format("{:.6g}", value.get<double>())
                                 : std::to_string(value.get<std::uint64_t>());
}

std::string_view signOf(std::string_view verdict) {
  return verdict == "proved" ? "✓" : verdict == "refuted" ? "✗" : verdict == "unknown" ? "?" : "–";
}
std::string badge(const std::string &verdict) {
  return fmt::format("<span class=\"badge {0}\">{1} {0}</span>", verdict, signOf(verdict));
}

std::string_view verdictOf(const Json &counts) {
  return counts.at("refuted") != 0 ? "refuted" : counts.at("unknown") != 0 ? "unknown" : "proved";
}
std::uint64_t allOf(const Json &counts) {
  std::uint64_t sum = 0;
  for (const Json &count : counts)
    sum += count.get<std::uint64_t>();
  return sum;
}

constexpr std::array kVerdicts = {"refuted", "unknown", "proved", "unreachable"};

class Page {
public:
  Page(const std::string &certificate, const Bundle &report)
      : document_(Json::parse(certificate)), sha256_(sha256(certificate)), report_(report) {}

  std::string write() {
    const std::size_t count = programs();
    head(count);
    verdict(count);
    summary();
    signOff();
    for (const Json &file : document_.at("files"))
      for (const Json &program : file.at("programs"))
        this->program(file, program);
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
  std::size_t programs() const {
    std::size_t count = 0;
    for (const Json &file : document_.at("files"))
      count += file.at("programs").size();
    return count;
  }
  /// Of one that stands in the page once: files may hold programs of one name.
  std::string anchorOf(const Json &file, const Json &program) const {
    return anchor("P-" + file.at("path").get<std::string>() + "-" + program.at("name").get<std::string>());
  }

  void head(std::size_t count) {
    std::string name = fmt::format("{} programs", count);
    if (count == 1)
      for (const Json &file : document_.at("files"))
        for (const Json &program : file.at("programs"))
          name = program.at("name");
    add("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"generator\" content=\"feedhold {}\">\n"
        "<meta name=\"certificate-sha256\" content=\"{}\">\n"
        "<title>Certificate: {}</title>\n<style>\n{}@page {{ @bottom-left {{ content: \"certificate {}\"; }} }}\n"
        "</style>\n</head>\n<body>\n<main>\n",
        text(document_.at("feedhold")), sha256_, xml(name), kPageStyle, sha256_.substr(0, 16));
    add("<header>\n<p class=\"kind\">Certificate of proof</p>\n<h1>{}</h1>\n<p class=\"meta\">{}feedhold {}", xml(name),
        document_.at("date").is_null() ? std::string() : text(document_.at("date")) + " &middot; ",
        text(document_.at("feedhold")));
    for (const Json &solver : document_.at("solvers"))
      add(" &middot; {}", text(solver));
    add("</p>\n<p class=\"meta\">certificate.json, SHA-256 <span class=\"hash\">{}</span></p>\n</header>\n", sha256_);
  }

  void verdict(std::size_t count) {
    const Json &counts = document_.at("counts");
    const std::string_view verdict = verdictOf(counts);
    const std::string_view words = verdict == "proved"    ? "Everything that was asked is proved"
                                   : verdict == "refuted" ? "Not fit for release: claims are refuted"
                                                          : "Not all is proved";
    add("<section class=\"verdict {}\">\n<p class=\"sign\" aria-hidden=\"true\">{}</p>\n<div>\n<h2>{}</h2>\n<p>{} "
        "claim{} about {} program{}:",
        verdict, signOf(verdict), words, allOf(counts), allOf(counts) == 1 ? "" : "s", count, count == 1 ? "" : "s");
    std::string_view between = " ";
    for (const char *each : kVerdicts)
      if (counts.at(each) != 0)
        add("{}<span class=\"count\">{}</span> {}", std::exchange(between, ", "), number(counts.at(each)), each);
    add("</p>\n<p>A claim is proved for all inputs at once, under the <a href=\"#assumptions\">assumptions</a> that "
        "this "
        "report lists. What was <a href=\"#not-checked\">not checked</a> is listed, too.</p>\n</div>\n</section>\n");
  }

  void summary() {
    add("<section id=\"summary\">\n<h2>Summary</h2>\n<table class=\"summary\">\n<thead><tr><th>Program</th>"
        "<th>In words</th><th class=\"n\">Proved</th><th class=\"n\">Refuted</th><th class=\"n\">Unknown</th>"
        "<th class=\"n\" title=\"no run comes to the place\">Unreach&shy;able</th></tr></thead>\n<tbody>\n");
    for (const Json &file : document_.at("files"))
      for (const Json &program : file.at("programs")) {
        const Json &counts = program.at("counts");
        const auto cell = [&](const char *verdict) {
          return fmt::format("<td class=\"n{}{}\">{}</td>", counts.at(verdict) == 0 ? " none " : " ",
                             counts.at(verdict) == 0 ? "" : verdict, number(counts.at(verdict)));
        };
        add("<tr><td><a class=\"name\" href=\"#{}\">{}</a><br><small>{}</small></td><td>{}{}</td>{}{}{}{}</tr>\n",
            anchorOf(file, program), text(program.at("name")), text(file.at("path")),
            program.at("title") == "" ? std::string() : fmt::format("<b>{}</b><br>", text(program.at("title"))),
            prose(program.at("summary")), cell("proved"), cell("refuted"), cell("unknown"), cell("unreachable"));
      }
    add("</tbody>\n</table>\n</section>\n");
  }

  void signOff() {
    add("<section id=\"sign-off\">\n<h2>Sign-off</h2>\n<p>Who signs has read the summary, the assumptions, what was "
        "not "
        "checked, and the findings.</p>\n<table class=\"sign-off\">\n<thead><tr><th></th><th>Name</th><th>Date</th>"
        "<th>Signature</th></tr></thead>\n<tbody>\n");
    for (const char *role : {"Author", "Checker", "Approver"})
      add("<tr><th>{}</th><td></td><td></td><td></td></tr>\n", role);
    add("</tbody>\n</table>\n</section>\n");
  }

  // ---- a program ----

  void program(const Json &file, const Json &program) {
    const Json &counts = program.at("counts");
    add("<section class=\"program\" id=\"{}\">\n<h2>{} <small>{}</small></h2>\n<p class=\"meta\">{}, line {} &middot; "
        "read for {}</p>\n<p class=\"sentence {}\">{}</p>\n",
        anchorOf(file, program), text(program.at("name")), text(program.at("title")), text(file.at("path")),
        number(program.at("line")), text(file.at("control")), verdictOf(counts), prose(program.at("summary")));
    if (!program.at("incomplete").is_null())
      add("<p class=\"warning\">Not all ways through it were followed: {}.</p>\n", prose(program.at("incomplete")));
    refutations(program);
    for (const Json &run : program.at("runs"))
      picture(run);
    contract(file, program);
    calls(program);
    obligations(file, program);
    add("</section>\n");
  }

  /// One call may break many claims.
  void refutations(const Json &program) {
    std::vector<std::vector<const Json *>> calls;
    std::map<std::string, std::size_t> byRun;
    for (const Json &row : program.at("obligations")) {
      if (row.at("verdict") != "refuted" || row.at("witness").is_null())
        continue;
      const auto [at, isNew] = byRun.try_emplace(row.at("witness").at("run"), calls.size());
      if (isNew)
        calls.emplace_back();
      calls[at->second].push_back(&row);
    }
    if (calls.empty())
      return;
    add("<h3>Calls that break a claim</h3>\n<p><small>The commands are for the folder of this report; "
        "<code>plot</code> "
        "in place of <code>run</code> draws the path.</small></p>\n");
    for (const std::vector<const Json *> &rows : calls) {
      add("<div class=\"witness\">\n<p class=\"call\"><code>{}</code></p>\n<ul>\n",
          text(rows.front()->at("witness").at("call")));
      for (const Json *row : rows)
        add("<li>line {}: <b>{}</b> <small>{}</small><br>{}{}</li>\n", number(row->at("line")),
            prose(row->at("message")), text(row->at("id")), prose(row->at("witness").at("happened")), guard(*row));
      add("</ul>\n<pre>{}</pre>\n</div>\n", text(rows.front()->at("witness").at("run")));
    }
  }
  static std::string guard(const Json &row) {
    return row.at("guard").is_null()
               ? std::string()
               : fmt::format("<br><small>it is proved with <code>{}</code> in the contract</small>",
                             text(row.at("guard")));
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
      add("<figcaption>One call that is allowed: <code>{}</code>. The proof is for all of them.", text(run.at("call")));
    else
      add("<figcaption>The call that breaks {}: <code>{}</code>.", text(run.at("witnessOf")), text(run.at("call")));
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

  void contract(const Json &file, const Json &program) {
    add("<h3>Contract</h3>\n");
    if (program.at("clauses").empty()) {
      add("<p>It has no contract: what is proved holds for every input.</p>\n");
      return;
    }
    add("<ul class=\"clauses\">\n");
    for (const Json &clause : program.at("clauses"))
      add("<li><code>{}</code> <small>{}line {}</small></li>\n", text(clause.at("text")),
          clause.at("path") == file.at("path") ? std::string() : text(clause.at("path")) + ", ",
          number(clause.at("line")));
    add("</ul>\n");
  }

  void calls(const Json &program) {
    if (program.at("calls").empty())
      return;
    add("<h3>Calls</h3>\n<ul class=\"calls\">\n");
    for (const Json &call : program.at("calls"))
      add("<li>{} line {} &rarr; <b>{}</b> <small>{}</small></li>\n", text(call.at("from")), number(call.at("line")),
          text(call.at("to")),
          call.at("path").is_null() ? std::string("not here: it may do anything") : text(call.at("path")));
    add("</ul>\n");
  }

  void obligations(const Json &file, const Json &program) {
    if (program.at("obligations").empty())
      return;
    add("<h3>Claims</h3>\n<table class=\"claims\">\n<thead><tr><th>Verdict</th><th class=\"n\">Line</th><th>Claim</th>"
        "<th>How</th></tr></thead>\n<tbody>\n");
    for (const char *verdict : kVerdicts)
      for (const Json &row : program.at("obligations"))
        if (row.at("verdict") == verdict)
          obligation(file, row);
    add("</tbody>\n</table>\n");
  }
  void obligation(const Json &file, const Json &row) {
    add("<tr><td>{}</td><td class=\"n\">{}</td><td>{}<br><small class=\"id\">{}{}</small>", badge(row.at("verdict")),
        number(row.at("line")), prose(row.at("claim")), text(row.at("id")),
        row.at("path") == file.at("path") ? std::string() : ", " + text(row.at("path")));
    if (!row.at("reason").is_null())
      add("<br><small>{}</small>", prose(row.at("reason")));
    if (!row.at("bound").is_null())
      add("<br><small>at most <code>{}</code> passes</small>", text(row.at("bound")));
    if (!row.at("margin").is_null())
      add("<br><small>margin {}</small>", number(row.at("margin")));
    if (row.at("exactOnly") == true)
      add("<br><small class=\"caution\">{}</small>", kExactOnly);
    if (row.at("verdict") == "unknown" && !row.at("guard").is_null())
      add("<br><small>it is proved with <code>{}</code> in the contract</small>", text(row.at("guard")));
    add("</td><td>");
    if (!row.at("grade").is_null())
      add("{}", text(row.at("grade")));
    if (!row.at("method").is_null())
      add("<br><small>{}, {} units</small>", text(row.at("method")), number(row.at("rlimit")));
    evidence(row.at("evidence"));
    add("</td></tr>\n");
  }
  /// A link to the first file: the others lie beside it.
  void evidence(const Json &row) {
    if (row.is_null())
      return;
    const std::string folder = row.at("folder");
    const bool isSolved = row.at("queries") != 0;
    const std::uint64_t count = row.at("queries").get<std::uint64_t>() + row.at("certificates").get<std::uint64_t>();
    if (isSolved && row.at("certificates") == 0)
      add("<br><small><a href=\"{}1.smt2\">query</a>", xml(folder));
    else
      add("<br><small><a href=\"{0}1.claim\">claim</a>, <a href=\"{0}1.certificate\">certificate</a>", xml(folder));
    if (count > 1)
      add(" and {} more there", count - 1);
    add("</small>");
  }

  // ---- behind the programs ----

  void notChecked() {
    add("<section id=\"not-checked\">\n<h2>What was not checked</h2>\n<ul>\n");
    std::size_t count = 0;
    const auto item = [&](const std::string &line) {
      add("<li>{}</li>\n", line);
      ++count;
    };
    if (!document_.at("reading").at("only").empty()) {
      std::string kinds;
      for (const Json &kind : document_.at("reading").at("only"))
        kinds += (kinds.empty() ? "" : ", ") + text(kind);
      item("All kinds of claims but these: " + kinds);
    }
    for (const Json &skipped : document_.at("skipped"))
      item(fmt::format("{}: {}", text(skipped.at("path")), prose(skipped.at("reason"))));
    for (const Json &file : document_.at("files"))
      for (const Json &program : file.at("programs"))
        notFollowed(file, program, item);
    if (count == 0)
      item("Nothing was passed over: all files were read, all calls found, all blocks followed.");
    add("</ul>\n</section>\n");
  }
  template <typename Item> void notFollowed(const Json &file, const Json &program, const Item &item) const {
    const std::string name = fmt::format("<a href=\"#{}\">{}</a>", anchorOf(file, program), text(program.at("name")));
    if (!program.at("incomplete").is_null())
      item(fmt::format("{}: not all ways were followed: {}", name, prose(program.at("incomplete"))));
    std::set<std::string> told;
    for (const Json &each : program.at("unfollowed"))
      if (const std::string line =
              fmt::format("{}: {} line {}: taken as anything at all: {}", name, text(each.at("path")),
                          number(each.at("line")), prose(each.at("reason")));
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
            finding.at("suppressed") == true ? " class=\"suppressed\"" : "", text(file.at("path")),
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
    add("<section id=\"assumptions\">\n<h2>Assumptions</h2>\n<p>What the proofs take for given, and who has to see to "
        "it.</p>\n<table>\n<thead><tr><th></th><th>Assumption</th><th>Who sees to it</th><th>Claims that rest on "
        "it</th>"
        "</tr></thead>\n<tbody>\n");
    for (const Json &row : document_.at("assumptions"))
      add("<tr id=\"{0}\"><td class=\"name\">{0}</td><td><b>{1}.</b> {2}</td><td>{3}</td><td>{4}</td></tr>\n",
          text(row.at("id")), text(row.at("title")), text(row.at("text")), text(row.at("who")), text(row.at("kinds")));
    add("</tbody>\n</table>\n</section>\n");
  }

  void identity() {
    add("<section id=\"identity\">\n<h2>Identity</h2>\n<p>The bytes that were read; paths are from the folder of this "
        "report.</p>\n<table class=\"identity\">\n<thead><tr><th>File</th><th>As</th><th class=\"n\">Bytes</th>"
        "<th>SHA-256</th></tr></thead>\n<tbody>\n");
    for (const Json &source : document_.at("sources")) {
      std::string roles;
      for (const Json &role : source.at("roles"))
        roles += (roles.empty() ? "" : ", ") + text(role);
      add("<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"hash\">{}</td></tr>\n", text(source.at("path")),
          roles, number(source.at("bytes")), text(source.at("sha256")));
    }
    add("</tbody>\n</table>\n<h3>Control and switches</h3>\n<table>\n<thead><tr><th>Files</th><th>Read for</th>"
        "<th>Chosen by</th><th>Switches that are not as the dialect has them</th></tr></thead>\n<tbody>\n");
    std::map<std::string, std::vector<std::string>> bySettings;
    for (const Json &file : document_.at("files"))
      bySettings[settings(file)].push_back(text(file.at("path")));
    for (const auto &[row, files] : bySettings)
      add("<tr><td>{}</td>{}</tr>\n",
          files.size() > 6 ? fmt::format("{} and {} more", files.front(), files.size() - 1)
                           : fmt::format("{}", fmt::join(files, "<br>")),
          row);
    add("</tbody>\n</table>\n</section>\n");
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
    add("<section id=\"disclaimer\">\n<h2>What this report is not</h2>\n<p>An NC program is no safety function, and "
        "this "
        "report is none. It replaces neither guards nor limit switches, and not the first run with the hand on the "
        "feed hold. It says nothing about fixtures, materials, cutting conditions and wear, nor about whether the part "
        "is the one on the drawing.</p>\n<h2>How to check it</h2>\n<p><code>feedhold recheck FOLDER</code> compares "
        "all "
        "hashes, proves everything again, follows every certificate and asks Z3 and cvc5 again. The evidence lies in "
        "<code>{}</code>.</p>\n</section>\n",
        kEvidenceFolder);
  }

  Json document_;
  std::string sha256_;
  const Bundle &report_;
  bool isStyled_ = false;
  std::string html_;
};

} // namespace

std::string pageOf(const std::string &certificate, const Bundle &report) { return Page(certificate, report).write(); }

} // namespace feedhold::certificate
