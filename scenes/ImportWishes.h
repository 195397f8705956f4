#pragma once
#include <optional>
#include <string>

namespace tessera::scenes {

/// How models are to be read, where a command says it. It holds for every model of a load, also for those that a scene
/// file names.
struct ImportWishes {
    bool isStrict = false;              ///< a picture that cannot be read refuses its model; else a stand-in is drawn
    std::optional<std::string> variant; ///< shown of the models that have one of this name (KHR_materials_variants)
    bool operator==(const ImportWishes&) const = default;
};

} // namespace tessera::scenes
