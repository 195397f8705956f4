#include "apps/ErrorLine.h"

#include <cstdio>
#include <string>

#include "base/OneLine.h"

namespace tessera::app {

void printProblem(std::string_view text) {
    const std::string line = "tessera: " + oneLine(text) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
}

} // namespace tessera::app
