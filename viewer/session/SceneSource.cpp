#include "viewer/session/SceneSource.h"

#include <filesystem>
#include <system_error>

#include "scenes/Load.h"
#include "viewer/session/Preferences.h"

namespace tessera::viewer {

std::string identityOf(const std::string& source) {
    if (scenes::builtinScene(source) != nullptr) return source;
    std::error_code error;
    const std::filesystem::path file = std::filesystem::absolute(source, error);
    return error ? source : file.lexically_normal().string();
}

void noteRecent(std::vector<std::string>& recent, const std::string& source) {
    std::error_code error;
    if (scenes::builtinScene(source) != nullptr || !std::filesystem::is_regular_file(source, error)) return;
    addRecent(recent, identityOf(source));
}

} // namespace tessera::viewer
