#include "apps/OutputFile.h"

#include <fmt/format.h>

#include "validation/AtomicFile.h"

namespace tessera::app {

bool isStandardOutput(const std::string& path) {
    return path == "-";
}

void requireOutput(const std::string& path) {
    if (!isStandardOutput(path)) validation::requireWritable(path);
}

void writeOutput(const std::string& path, std::string_view text) {
    if (isStandardOutput(path))
        fmt::print("{}", text);
    else
        validation::writeFileAtomically(path, text);
}

} // namespace tessera::app
