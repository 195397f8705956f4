#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/CheckElement.h"
#include "scenes/CheckHook.h"
#include "scenes/CheckLight.h"
#include "scenes/CheckRig.h"
#include "scenes/Limits.h"
#include "scenes/Scene.h"

namespace tessera::scenes {
namespace {

void checkImage(const CheckedElement& element, const Image& image) {
    element.require(image.width > 0 && image.height > 0,
                    fmt::format("{} x {} texels; both must be positive", image.width, image.height));
    const std::size_t bytes =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * texelBytes(image.format);
    element.require(image.texels.size() == bytes, fmt::format("holds {} bytes of texels, but {} x {} texels need {}",
                                                              image.texels.size(), image.width, image.height, bytes));
    if (image.format != TexelFormat::Rgba32Float) return;
    for (std::size_t offset = 0; offset < bytes; offset += sizeof(float)) {
        float value = 0.0f;
        std::memcpy(&value, image.texels.data() + offset, sizeof(value));
        if (!std::isfinite(value)) element.require(false, "a texel is not finite");
    }
}

void checkMaterial(const CheckedElement& element, const Material& material, std::size_t imageCount) {
    visitFields(kMaterialFields, [&](const auto& field) {
        if (!isWithin(material.*field.member, field))
            element.require(false, fmt::format("{} must be {}", field.what, boundsText(field.least, field.most)));
    });
    visitFields(kSubsurfaceFields, [&](const auto& field) {
        if (!isWithin(material.subsurface.*field.member, field))
            element.require(false, fmt::format("{} must be {}", field.what, boundsText(field.least, field.most)));
    });
    const std::string profile = profileProblem(material.subsurface.profile);
    element.require(profile.empty(), profile);
    element.require(supportsMasking(material.model, material.masking),
                    "masking by direction needs the model microfacet_anisotropic");
    for (const TextureUse& use : material.textures) {
        if (use.image == kNone) continue;
        element.requireIndex(use.image, imageCount, "image");
        element.require(use.texCoordSet == 0 || use.texCoordSet == 1,
                        "uses a texture coordinate set other than 0 and 1");
        element.require(allFinite(use.transform.offset) && allFinite(use.transform.scale) &&
                            std::isfinite(use.transform.rotationRadians),
                        "a texture transform is not finite");
    }
}

template <typename Vector>
void checkAttribute(const CheckedElement& element, const std::vector<Vector>& values, std::size_t vertices,
                    std::string_view what) {
    if (values.size() != vertices) {
        element.require(false, fmt::format("has {} positions but {} {}", vertices, values.size(), what));
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!allFinite(values[i])) element.require(false, fmt::format("entry {} of its {} is not finite", i, what));
    }
}

void checkMesh(const CheckedElement& element, const Mesh& mesh) {
    const std::size_t vertices = mesh.positionsOS.size();
    checkAttribute(element, mesh.positionsOS, vertices, "positions");
    checkAttribute(element, mesh.normalsOS, vertices, "normals");
    if (!mesh.tangentsOS.empty()) checkAttribute(element, mesh.tangentsOS, vertices, "tangents");
    for (const std::vector<glm::vec2>& set : mesh.texCoords) {
        if (!set.empty()) checkAttribute(element, set, vertices, "texture coordinates");
    }
    if (!mesh.colors.empty()) checkAttribute(element, mesh.colors, vertices, "colours");
    element.require(mesh.indices.size() % 3 == 0,
                    fmt::format("has {} indices, which are no whole number of triangles", mesh.indices.size()));
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        if (mesh.indices[i] >= vertices) {
            element.require(false,
                            fmt::format("index {} is {}, but there are {} vertices", i, mesh.indices[i], vertices));
        }
    }
}

void checkNode(const CheckedElement& element, const Node& node, std::size_t index, const Scene& scene) {
    element.require(node.parent >= kNone && node.parent < static_cast<int>(index),
                    fmt::format("its parent {} does not stand before it", node.parent));
    element.require(allFinite(node.parentFromNode), "its transform is not finite");
    for (const MeshInstance& instance : node.instances) {
        element.requireIndex(instance.mesh, scene.meshes.size(), "mesh");
        element.requireIndex(instance.material, scene.materials.size(), "material");
    }
}

Box3 boxOf(const Mesh& mesh) {
    Box3 boxOS;
    for (const glm::vec3& positionOS : mesh.positionsOS) boxOS.extend(glm::dvec3(positionOS));
    return boxOS;
}

void checkCamera(const CheckedElement& element, const Camera& camera) {
    const glm::dmat4& m = camera.worldFromCamera;
    const glm::dmat3 rotation(m);
    element.require(allFinite(m), "its transform is not finite");
    element.require(isUnit(rotation[0]) && isUnit(rotation[1]) && isUnit(rotation[2]) &&
                        std::abs(glm::determinant(rotation) - 1.0) <= 3.0 * kUnitTolerance && m[0].w == 0.0 &&
                        m[1].w == 0.0 && m[2].w == 0.0 && m[3].w == 1.0,
                    "its transform must only rotate and move");
    element.require(camera.farMetres > camera.nearMetres, "its far plane must lie beyond its near plane");
    if (camera.projection == Projection::Perspective) {
        element.require(camera.fovYRadians > 0.0 && camera.fovYRadians < std::numbers::pi,
                        "its field of view must be between 0 and pi");
        element.require(std::isfinite(camera.nearMetres) && camera.nearMetres > 0.0, "its near plane must be positive");
    } else {
        element.require(std::isfinite(camera.halfHeightMetres) && camera.halfHeightMetres > 0.0,
                        "its half height must be positive");
        element.require(std::isfinite(camera.nearMetres) && camera.nearMetres >= 0.0,
                        "its near plane must not be negative");
    }
    const std::string problem = limitProblem(camera);
    element.require(problem.empty(), problem);
}

} // namespace

void checkEnvironment(const Scene& scene, const Environment& environment) {
    const CheckedElement element{scene, "environment", 0, environment.map.name};
    checkImage(element, environment.map);
    element.require(environment.map.format == TexelFormat::Rgba32Float, "its map must hold fp32");
    const auto requireWithin = [&](float value, double least, const char* what) {
        element.require(between(double(value), least, kAnyNumber),
                        fmt::format("{} must be {}", what, boundsText(least, kAnyNumber)));
    };
    requireWithin(environment.intensity, 0.0, "its intensity");
    requireWithin(environment.rotationDegrees, -kAnyNumber, "its rotation");
    float darkest = 0.0f, brightest = 0.0f;
    for (std::size_t offset = 0; offset < environment.map.texels.size(); offset += sizeof(glm::vec4)) {
        glm::vec3 texel;
        std::memcpy(&texel, environment.map.texels.data() + offset, sizeof(texel));
        darkest = std::min({darkest, texel.r, texel.g, texel.b});
        brightest = std::max({brightest, texel.r, texel.g, texel.b});
    }
    element.require(darkest >= 0.0f, "a texel is below 0");
    const double most = double(brightest) * double(environment.intensity);
    element.require(most <= double(kMostRadiance),
                    fmt::format("its brightest texel times its intensity is {:g}, and at most {:g} can be shown; lower "
                                "its intensity",
                                most, kMostRadiance));
}

namespace {

void checkSceneWide(const Scene& scene) {
    const auto require = [&](bool holds, const std::string& problem) {
        if (!holds) throw InputError(fmt::format("scene '{}': {}", scene.name, problem));
    };
    require(allFiniteAndNotNegative(scene.background), "the background must be finite and not negative");
    if (scene.environment) checkEnvironment(scene, *scene.environment);
    const auto subsurfaces = std::ranges::count_if(
        scene.materials, [](const Material& material) { return material.subsurface.method != SubsurfaceMethod::None; });
    require(subsurfaces <= kMostSubsurfaces, fmt::format("{} materials have a subsurface, and at most {} can; share "
                                                         "materials, or set the method of some to none",
                                                         subsurfaces, kMostSubsurfaces));
    checkHook(scene);
    const SceneOptions& options = scene.options;
    for (const auto& [key, option] : options.requested) {
        const auto* const number = std::get_if<double>(&option);
        const auto* const list = std::get_if<std::vector<double>>(&option);
        const bool areFinite = list == nullptr || std::ranges::all_of(*list, [](double n) { return std::isfinite(n); });
        require((number == nullptr || std::isfinite(*number)) && areFinite,
                fmt::format("the option {} is not finite", key));
    }
    if (!options.camera) return;
    bool found = false;
    for (const Camera& camera : scene.cameras) found = found || camera.name == *options.camera;
    require(found, fmt::format("the option camera names '{}', but no camera is called that", *options.camera));
}

} // namespace

void checkPlaces(const Scene& scene) {
    std::vector<Box3> boxesOS;
    std::transform(scene.meshes.begin(), scene.meshes.end(), std::back_inserter(boxesOS), boxOf);
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const CheckedElement element(scene, "node", i, scene.nodes[i].name);
        for (const MeshInstance& instance : scene.nodes[i].instances) {
            const Box3& boxOS = boxesOS[static_cast<std::size_t>(instance.mesh)];
            if (boxOS.empty()) continue;
            for (const double x : {boxOS.min.x, boxOS.max.x})
                for (const double y : {boxOS.min.y, boxOS.max.y})
                    for (const double z : {boxOS.min.z, boxOS.max.z})
                        if (!isNearEnough(glm::dvec3(worldFromNode[i] * glm::dvec4(x, y, z, 1.0))))
                            element.require(
                                false, fmt::format("part of it lies more than {:g} m from the origin; make the scene "
                                                   "smaller",
                                                   kFarthestMetres));
        }
    }
    // Only for elements attached to nodes; checkLight() and checkCamera() check others. Huge scales leave no direction.
    const auto requireNear = [&](bool isNear, std::string_view kind, int index, const std::string& name) {
        if (!isNear)
            CheckedElement(scene, kind, std::size_t(index), name)
                .require(false, fmt::format("its node carries it more than {:g} m from the origin; keep it nearer",
                                            kFarthestMetres));
    };
    for (const Carried& carried : scene.rig.lights) {
        const Light& light = scene.lights[std::size_t(carried.element)];
        requireNear(isNearEnough(light.positionWS) && allFinite(light.directionWS), "light", carried.element,
                    light.name);
    }
    for (const Carried& carried : scene.rig.cameras) {
        const Camera& camera = scene.cameras[std::size_t(carried.element)];
        requireNear(isNearEnough(glm::dvec3(camera.worldFromCamera[3])) && allFinite(camera.worldFromCamera), "camera",
                    carried.element, camera.name);
    }
}

void checkScene(const Scene& scene) {
    const auto checkName = [&](std::string_view kind, const std::string& name) {
        if (name.size() > kMostNameBytes)
            throw InputError(fmt::format("scene '{:.40}': a {} has a name of {} bytes, and at most {} can be used; "
                                         "shorten it",
                                         scene.name, kind, name.size(), kMostNameBytes));
    };
    const auto checkNames = [&](std::string_view kind, const auto& elements) {
        for (const auto& element : elements) checkName(kind, element.name);
    };
    checkName("scene", scene.name);
    checkNames("picture", scene.images);
    checkNames("material", scene.materials);
    checkNames("mesh", scene.meshes);
    checkNames("node", scene.nodes);
    checkNames("light", scene.lights);
    checkNames("camera", scene.cameras);
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        checkImage({scene, "image", i, scene.images[i].name}, scene.images[i]);
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        checkMaterial({scene, "material", i, scene.materials[i].name}, scene.materials[i], scene.images.size());
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        checkMesh({scene, "mesh", i, scene.meshes[i].name}, scene.meshes[i]);
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        checkNode({scene, "node", i, scene.nodes[i].name}, scene.nodes[i], i, scene);
    }
    checkRig(scene);
    checkPlaces(scene);
    std::set<const LightPicture*> pictures; // lights may share a texture
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        checkLight({scene, "light", i, scene.lights[i].name}, scene.lights[i]);
        const LightTexture& texture = scene.lights[i].texture;
        if (texture && pictures.insert(&*texture).second)
            checkImage({scene, "texture of light", i, scene.lights[i].name}, texture->map);
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        checkCamera({scene, "camera", i, scene.cameras[i].name}, scene.cameras[i]);
    }
    checkSceneWide(scene);
}

} // namespace tessera::scenes
