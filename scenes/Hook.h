#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

/// GLSL of a scene's own that changes its surfaces and moves its vertices (docs/hooks.md).
namespace tessera::scenes {

inline constexpr std::size_t kMostHookParameters = 15;
inline constexpr std::size_t kMostHookBytes = std::size_t(1) << 20; ///< of its file

/// A number that a hook reads as hook.<name>.
struct HookParameter {
    std::string name; ///< isHookParameterName()
    float value = 0.0f;
    float least = 0.0f; ///< the value lies between the two
    float most = 1.0f;
    bool operator==(const HookParameter&) const = default;

    bool allows(float other) const { return other >= least && other <= most; } // false for NaN
};

/// Another value for the parameter of that name.
struct HookValue {
    std::string name;
    float value = 0.0f;
    bool operator==(const HookValue&) const = default;
};

struct Hook {
    std::string file;              ///< absolute
    std::uint64_t contentHash = 0; ///< of the file's text as it was loaded
    std::vector<int> materials;    ///< those whose surfaces it changes, ascending
    std::vector<HookParameter> parameters;
    bool changesSurfaces = true; ///< it has hookSurface()
    bool movesVertices = false;  ///< it has hookVertex(), and the scene's meshes are as it found them
    double mayMoveMetres = 0.0;  ///< as far as it moves a vertex at most, in the mesh's own space
    bool operator==(const Hook&) const = default;

    bool changes(std::size_t material) const;
};

/// The numbers that hookSurface() changes (shaders/lib/material/hook_interface.glsl).
struct HookedSurface {
    glm::vec3 color{0.0f};    ///< linear
    glm::vec3 emission{0.0f}; ///< radiance
    float alpha = 1.0f;       ///< of GGX; 1 where the model has none
    float metallic = 0.0f;    ///< 0 where the model has none
    bool operator==(const HookedSurface&) const = default;
};
/// All that it gets at a point.
struct HookPoint {
    HookedSurface surface; ///< as the material has it
    glm::vec2 uv{0.0f};
    glm::vec3 positionOS{0.0f};
    int instance = 0;
    bool operator==(const HookPoint&) const = default;
};

/// A letter, then up to 31 letters and digits; not the name of what every hook has, timeSeconds.
bool isHookParameterName(std::string_view name);

/// Gives a parameter the value. Throws InputError where the hook has none of that name, or the value is not within its
/// bounds; then nothing has changed.
void setHookValue(Hook& hook, const HookValue& value);

/// Which functions a text names outside of comments.
struct HookFunctions {
    bool surface = false, vertex = false;
};
HookFunctions hookFunctions(std::string_view text);

/// What keeps a text from being a hook.
struct HookFault {
    std::size_t line; ///< from 1
    std::string why;  ///< with the remedy
};
/// The first of what would break the promises that other passes and techniques rely on; none where there is none. A
/// driver finds what is no GLSL.
std::optional<HookFault> hookFault(std::string_view text);
/// Throws InputError with the file's name, the line and the remedy where there is one.
void requireHook(const std::string& file, std::string_view text);

/// Checks the text as requireHook() does and returns it for programs: macros expanded, comments removed, lines kept,
/// declared names prefixed by kHookPrefix, loops guarded (HookLoops.h). So a hook reaches only its documented
/// interface.
std::string hookProgramText(const std::string& file, std::string_view text);

} // namespace tessera::scenes
