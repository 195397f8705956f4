#include "renderer/shader/ShaderPath.h"

#include <filesystem>

namespace tessera::shader {
namespace {

constexpr std::string_view kRoot = "shaders/";

void addCandidate(std::vector<std::string>& candidates, const std::filesystem::path& path) {
    const std::string normal = path.lexically_normal().generic_string();
    if (!normal.empty() && normal.front() != '/' && !normal.starts_with("..")) candidates.push_back(normal);
}

} // namespace

std::string displayPath(std::string_view path) {
    return std::filesystem::path(path).is_absolute() ? std::string(path) : std::string(kRoot) + std::string(path);
}

std::vector<std::string> includeCandidates(const std::string& wanted, const std::string& including) {
    std::vector<std::string> candidates;
    addCandidate(candidates, wanted);
    if (wanted.starts_with(kRoot)) addCandidate(candidates, wanted.substr(kRoot.size()));
    addCandidate(candidates, std::filesystem::path(including).parent_path() / wanted);
    return candidates;
}

} // namespace tessera::shader
