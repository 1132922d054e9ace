#include "surface/cli/client_streams.h"

#include <iostream>

namespace feedhold {

int serveClient(const lsp::ServerOptions &options) {
  std::ios::sync_with_stdio(false); // a stream with a buffer reads bodies in one piece
  std::cin.tie(nullptr);            // reading would write what waits in cout, from a thread that does not hold its lock
  return lsp::serve(std::cin, std::cout, options);
}

} // namespace feedhold
