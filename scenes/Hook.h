#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

/// Hooks: a scene's own GLSL, which changes surfaces and moves vertices (docs/hooks.md).
namespace tessera::scenes {

inline constexpr std::size_t kMostHookParameters = 15;
inline constexpr std::size_t kMostHookBytes = std::size_t(1) << 20; ///< size of a hook's file

/// A number that a hook reads as hook.<name>.
struct HookParameter {
    std::string name; ///< isHookParameterName()
    float value = 0.0f;
    float least = 0.0f; ///< bounds of the value: least to most
    float most = 1.0f;
    bool operator==(const HookParameter&) const = default;

    bool allows(float other) const { return other >= least && other <= most; } // false for NaN
};

/// A new value for the parameter of that name.
struct HookValue {
    std::string name;
    float value = 0.0f;
    bool operator==(const HookValue&) const = default;
};

struct Hook {
    std::string file;              ///< absolute
    std::uint64_t contentHash = 0; ///< hash of the file's text as loaded
    std::vector<int> materials;    ///< indices of the materials that it changes, ascending
    std::vector<HookParameter> parameters;
    bool changesSurfaces = true; ///< defines hookSurface()
    bool movesVertices = false;  ///< defines hookVertex(); the scene's meshes hold the unmoved vertices
    double mayMoveMetres = 0.0;  ///< maximum distance that it moves a vertex, in object space
    bool operator==(const Hook&) const = default;

    bool changes(std::size_t material) const;
};

/// The surface values that hookSurface() changes (shaders/lib/material/hook_interface.glsl).
struct HookedSurface {
    glm::vec3 color{0.0f};    ///< linear
    glm::vec3 emission{0.0f}; ///< radiance
    float alpha = 1.0f;       ///< GGX alpha; 1 if the model has none
    float metallic = 0.0f;    ///< 0 if the model has none
    bool operator==(const HookedSurface&) const = default;
};
/// All inputs of hookSurface() at a point.
struct HookPoint {
    HookedSurface surface; ///< values of the material before the hook
    glm::vec2 uv{0.0f};
    glm::vec3 positionOS{0.0f};
    int instance = 0;
    bool operator==(const HookPoint&) const = default;
};

/// Whether a parameter name is valid: a letter, then up to 31 letters and digits; not the built-in timeSeconds.
bool isHookParameterName(std::string_view name);

/// Sets a parameter. Throws InputError, without a change, if the hook has no such parameter or the value is out of
/// bounds.
void setHookValue(Hook& hook, const HookValue& value);

/// The hook functions that a text names outside of comments.
struct HookFunctions {
    bool surface = false, vertex = false;
};
HookFunctions hookFunctions(std::string_view text);

/// An error in a hook's text.
struct HookFault {
    std::size_t line; ///< from 1
    std::string why;  ///< including the remedy
};
/// Finds the first violation of the rules that other passes and techniques rely on; none if there is none. Invalid GLSL
/// is left to the driver.
std::optional<HookFault> hookFault(std::string_view text);
/// Throws InputError with the file's name, the line and the remedy if hookFault() finds one.
void requireHook(const std::string& file, std::string_view text);

/// Checks the text like requireHook() and returns it for inclusion in shaders: macros expanded, comments removed, lines
/// kept, declared names prefixed by kHookPrefix, loops guarded (HookLoops.h). A hook can thus access only its
/// documented interface.
std::string hookProgramText(const std::string& file, std::string_view text);

} // namespace tessera::scenes
