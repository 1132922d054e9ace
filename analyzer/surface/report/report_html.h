// What the parts of a certificate's page are written with.  Internal to sink/.
#pragma once

#include "surface/report/report_parts.h"
#include "surface/sink/xml.h"

#include <fmt/format.h>

namespace feedhold::certificate {

/// A string of the document.
std::string text(const Json &value);

/// Code in backticks becomes code.
std::string prose(std::string_view words);
std::string prose(const Json &value);

std::string number(const Json &value);

/// `1 claim`, `2 claims`
std::string counted(std::uint64_t count, std::string_view thing);

/// An anchor: plain letters and digits.  Of a program it stands in the page once: files may hold programs of one name.
std::string anchorOf(const std::string &path, const std::string &program);
std::string anchorOf(const Json &file, const Json &program);

/// What a claim or a program is shown as: a class of the style, a sign and a word, so that no colour is needed.
struct Look {
  std::string_view style;
  std::string_view sign;
  std::string_view word;
};
Look lookOfClaim(const Json &obligation);
/// Of a program, or of all.
Look lookOfStatus(const Json &status);
std::string badge(const Look &look);

/// Paths of programs as the page has them: below the folder that all of them lie in.
class ShownPaths {
public:
  explicit ShownPaths(const Json &document);
  /// Ends with `/`; empty: there is none.
  const std::string &folder() const { return folder_; }
  std::string of(const Json &path) const;

private:
  std::string folder_;
};

/// The section on who calls whom; empty: nobody calls anybody.
std::string callsOf(const Json &document);

/// The section of one program.  `isStyled`: a picture before has brought the style of pictures along.
std::string programOf(const Json &file, const Json &program, const ShownPaths &paths, const Bundle &report,
                      bool &isStyled);

} // namespace feedhold::certificate
