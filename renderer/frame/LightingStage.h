#pragma once
#include <cstdint>
#include <span>
#include <string_view>

/// Shader stage that lights the G-buffer. Names are those of the command line; the table is the only list.
namespace tessera::frame {

enum class LightingStage : std::uint8_t { Fragment, Compute };
struct LightingStageInfo {
    LightingStage stage;
    std::string_view name;
    std::string_view summary;
};
std::span<const LightingStageInfo> lightingStageTable();
const LightingStageInfo& infoOf(LightingStage stage);

} // namespace tessera::frame
