// Making a certificate: what `certify` and `recheck` do alike.
#pragma once

#include "surface/sink/certificate.h"
#include "surface/sink/prove_shown.h"

namespace feedhold {

struct CertificateRun {
  Bundle report; // empty when something could not be read
  VerdictCounts counts;
  std::size_t programs = 0;
  Standing standing = Standing::Ready; // the worst of all programs
  std::vector<PathProblem> problems;
};

/// Checks and proves; what is open is proved once more in search of a clause that would help.
CertificateRun runCertificate(const CertificateWish &wish, const std::filesystem::path &folder, unsigned jobs);

} // namespace feedhold
