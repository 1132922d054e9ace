// URIs of files: what is escaped, how drives and servers of Windows are written, and the way back.
#include "base/source/file_uri.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <string>

namespace feedhold {
namespace {

struct UriCase {
  std::string_view path;
  std::string_view uri;
};

constexpr std::array kUris = {
    UriCase{"/c d/part.nc", "file:///c%20d/part.nc"},
    UriCase{"/shop/%41#1.nc", "file:///shop/%2541%231.nc"},
    UriCase{"/shop/a:b", "file:///shop/a%3Ab"},
    UriCase{"/b\xc3\xb6hrer.nc", "file:///b%C3%B6hrer.nc"},
    UriCase{"Z:/c d/part.nc", "file:///Z:/c%20d/part.nc"},
    UriCase{"c:/", "file:///c:/"},
    UriCase{"//server/nc files/O1.nc", "file://server/nc%20files/O1.nc"},
};

TEST(FileUri, OfAbsolutePaths) {
  for (const auto &[path, uri] : kUris)
    EXPECT_EQ(uriOfAbsolute(path), uri);
}

TEST(FileUri, OfPathsIsNormal) {
  EXPECT_EQ(uriOfPath("/shop/../mill/./O1.nc"), "file:///mill/O1.nc");
  EXPECT_EQ(uriOfPath("/shop/"), "file:///shop/");
  EXPECT_EQ(uriOfPath("O1.nc"), uriOfPath(std::filesystem::current_path() / "O1.nc"));
}

TEST(FileUri, PathsOfUris) {
  EXPECT_EQ(pathOfUri("file:///c%20d/%C3%B6.nc"), "/c d/\xc3\xb6.nc");
  EXPECT_EQ(pathOfUri("file://localhost/shop/O1.nc"), "/shop/O1.nc");
  EXPECT_EQ(pathOfUri("file:///100%/O%4.nc"), "/100%/O%4.nc");
  EXPECT_EQ(pathOfUri("untitled:Untitled-1"), "");
  EXPECT_EQ(pathOfUri("file://"), "");
}

RC_GTEST_PROP(FileUri, LeadsBack, (const std::string &name)) {
  const std::string path = "/" + name;
  RC_PRE(path.find('\0') == std::string::npos && !path.starts_with("//"));
  RC_ASSERT(pathOfUri(uriOfAbsolute(path)) == path);
}

} // namespace
} // namespace feedhold
