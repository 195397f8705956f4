#pragma once
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::test {

/// Khronos models with clips, skins or morph targets, below the folder of third-party models.
inline constexpr std::string_view kAnimatedModels[] = {"Fox/Fox.glb",
                                                       "SimpleSkin/SimpleSkin.gltf",
                                                       "RiggedSimple/RiggedSimple.glb",
                                                       "RiggedFigure/RiggedFigure.glb",
                                                       "CesiumMan/CesiumMan.glb",
                                                       "BrainStem/BrainStem.glb",
                                                       "InterpolationTest/InterpolationTest.glb",
                                                       "SimpleMorph/SimpleMorph.gltf",
                                                       "AnimatedMorphCube/AnimatedMorphCube.glb",
                                                       "AnimatedMorphCube-Quantized/AnimatedMorphCube.gltf",
                                                       "AnimatedMorphSphere/AnimatedMorphSphere.glb",
                                                       "MorphStressTest/MorphStressTest.glb",
                                                       "AnimatedTriangle/AnimatedTriangle.gltf",
                                                       "AnimatedCube/AnimatedCube.gltf",
                                                       "AnimatedColorsCube/AnimatedColorsCube.glb",
                                                       "BoxAnimated/BoxAnimated.glb"};

/// A file in the folder that TESSERA_ASSETS names, else in the assets folder beside the sources; none if missing.
inline std::optional<std::filesystem::path> fileOfAssets(std::string_view name) {
    const char* named = std::getenv("TESSERA_ASSETS");
    const std::filesystem::path folder = named != nullptr && *named != '\0'
                                             ? std::filesystem::path(named)
                                             : std::filesystem::path(TESSERA_SOURCE_DIR) / ".." / "shared" / "assets";
    std::filesystem::path file = folder / name;
    if (!std::filesystem::exists(file)) return {};
    return file;
}

/// Animated models of the repository, available everywhere: a bar bent by a skin, a box with morph targets, a plate
/// whose thin film a clip animates.
inline constexpr std::string_view kOwnModels[] = {"skinned_bar.gltf", "morphing_box.gltf", "textured_film.gltf"};

inline std::filesystem::path ownModelsFolder() {
    return std::filesystem::path(TESSERA_SOURCE_DIR) / "tests" / "support" / "models";
}

/// The folder that TESSERA_ASSETS names, else the folder of the repository's models.
inline std::filesystem::path sweptFolder() {
    const char* named = std::getenv("TESSERA_ASSETS");
    return named != nullptr && *named != '\0' ? std::filesystem::path(named) : ownModelsFolder();
}

/// The glTF files of a folder and those below it, in order.
inline std::vector<std::filesystem::path> modelsBelow(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> models;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (entry.is_regular_file() && (extension == ".gltf" || extension == ".glb")) models.push_back(entry.path());
    }
    std::ranges::sort(models);
    return models;
}

} // namespace tessera::test
