#include "scenes/import/GltfLightUnits.h"

#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace tessera::scenes::gltf {
namespace {

using ExporterVersion = std::pair<int, int>; ///< major, minor

/// Of Blender's exporter, where a text such as "Khronos glTF Blender I/O v4.2.57" names it; 0.0 where it says none.
std::optional<ExporterVersion> blenderVersion(std::string_view generator) {
    constexpr std::string_view kBlender = "glTF Blender I/O";
    const std::size_t at = generator.find(kBlender);
    if (at == std::string_view::npos) return std::nullopt;
    ExporterVersion version{0, 0};
    const std::size_t digits = generator.find_first_of("0123456789", at + kBlender.size());
    if (digits == std::string_view::npos) return version;
    const char* const end = generator.data() + generator.size();
    const char* const dot = std::from_chars(generator.data() + digits, end, version.first).ptr;
    if (dot != end && *dot == '.') std::from_chars(dot + 1, end, version.second);
    return version;
}

} // namespace

void takeLightUnits(Document& document, std::vector<std::string>& notes) {
    if (document.model.lights.empty()) return;
    const std::optional<LightUnits> wish = document.ledger.wishes().lightUnits;
    const std::optional<ExporterVersion> blender = blenderVersion(document.model.asset.generator);
    if (!(wish ? wish == LightUnits::Lumen : blender.has_value())) return;
    constexpr ExporterVersion kSunsToo{3, 4};
    bool areDivided = false;
    for (std::size_t i = 0; i < document.model.lights.size(); ++i) {
        const bool isWatts = !wish && document.model.lights[i].type == "directional" && *blender < kSunsToo;
        if (isWatts) continue;
        areDivided = true;
        document.wattsPerUnit[i] = 1.0 / kLumensPerWatt;
    }
    if (!wish && areDivided)
        notes.push_back(fmt::format("its lights are in lumens, {} for each watt, as Blender exports them, and shown in "
                                    "watts; --light-units watt takes them as they are",
                                    kLumensPerWatt));
}

} // namespace tessera::scenes::gltf
