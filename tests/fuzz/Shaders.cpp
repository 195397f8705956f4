#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "renderer/shader/Preprocess.h"
#include "scenes/Hook.h"
#include "tests/fuzz/Readers.h"

namespace tessera::fuzz {

/// Expands a file of shaders/ that may include those beside it, and itself.
void expandShader(const std::filesystem::path& file) {
    const shader::SourceTree tree(file.parent_path());
    shader::mapLog(shader::expand(tree, file.filename().string()).text, {});
}

/// Checks a hook's text. A fault must name one of the text's lines, and a reason.
void readHook(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    const std::optional<scenes::HookFault> fault = scenes::hookFault(text);
    const auto lines = std::size_t(1 + std::ranges::count(text, '\n'));
    if (fault && (fault->line < 1 || fault->line > lines || fault->why.empty())) std::abort();
    if (fault) return;
    const scenes::HookFunctions functions = scenes::hookFunctions(text);
    if (!functions.surface && !functions.vertex) std::abort();
}

} // namespace tessera::fuzz
