#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/AreaLight.h"
#include "scenes/CheckRig.h"
#include "scenes/Limits.h"
#include "scenes/Scene.h"

namespace tessera::scenes {
namespace {

/// How far the length of a unit vector, or a rotation's columns, may be off: the rounding of single precision and of
/// files with a few decimals, far below the visible.
constexpr double kUnitTolerance = 1e-3;

template <typename Vector>
bool allFinite(const Vector& vector) {
    for (glm::length_t i = 0; i < vector.length(); ++i) {
        if (!std::isfinite(vector[i])) return false;
    }
    return true;
}

bool allFinite(const glm::dmat4& matrix) {
    return allFinite(matrix[0]) && allFinite(matrix[1]) && allFinite(matrix[2]) && allFinite(matrix[3]);
}

template <typename Vector>
bool allFiniteAndNotNegative(const Vector& vector) {
    for (glm::length_t i = 0; i < vector.length(); ++i) {
        if (!std::isfinite(vector[i]) || vector[i] < 0) return false;
    }
    return true;
}

bool between(double value, double low, double high) {
    return value >= low && value <= high; // false for NaN
}

template <typename Vector>
bool allBetween(const Vector& vector, double low, double high) {
    for (glm::length_t i = 0; i < vector.length(); ++i) {
        if (!between(double(vector[i]), low, high)) return false;
    }
    return true;
}

bool isUnit(const glm::dvec3& vector) {
    return allFinite(vector) && std::abs(glm::length(vector) - 1.0) <= kUnitTolerance;
}

/// One element of a scene, as messages call it.
class Element {
public:
    Element(const Scene& scene, std::string_view kind, std::size_t index, const std::string& name)
        : scene_(scene), kind_(kind), index_(index), name_(name) {}

    void require(bool holds, std::string_view problemAndRemedy) const {
        if (holds) return;
        const std::string quoted = name_.empty() ? std::string() : " '" + name_ + "'";
        throw InputError(fmt::format("scene '{}': {} {}{}: {}", scene_.name, kind_, index_, quoted, problemAndRemedy));
    }

    void requireIndex(int index, std::size_t count, std::string_view kind) const {
        if (index >= 0 && static_cast<std::size_t>(index) < count) return;
        require(false, fmt::format("refers to {} {}, but the scene has {}", kind, index, count));
    }

private:
    const Scene& scene_;
    std::string_view kind_;
    std::size_t index_;
    const std::string& name_;
};

void checkImage(const Element& element, const Image& image) {
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

/// What messages say of bounds.
std::string boundsText(double least, double most) {
    if (most < kAnyNumber) return fmt::format("between {:g} and {:g}", least, most);
    return least < 0.0 ? "finite" : "finite and not negative";
}

/// Whether a number, or each component of a vector, lies between the bounds of its field. Nothing else has bounds.
template <typename Value, typename Field>
bool isWithin(const Value&, const Field&) {
    return true;
}
/// Single precision may round a value that is a bound beyond it, so bounds are rounded alike.
template <typename Field>
bool isWithin(float value, const Field& field) {
    return value >= float(field.least) && value <= float(field.most); // false for NaN
}
template <glm::length_t Length, typename Field>
bool isWithin(const glm::vec<Length, float>& vector, const Field& field) {
    for (glm::length_t i = 0; i < Length; ++i)
        if (!isWithin(vector[i], field)) return false;
    return true;
}

void checkMaterial(const Element& element, const Material& material, std::size_t imageCount) {
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
    element.require(takesMasking(material.model, material.masking),
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
void checkAttribute(const Element& element, const std::vector<Vector>& values, std::size_t vertices,
                    std::string_view what) {
    if (values.size() != vertices) {
        element.require(false, fmt::format("has {} positions but {} {}", vertices, values.size(), what));
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!allFinite(values[i])) element.require(false, fmt::format("entry {} of its {} is not finite", i, what));
    }
}

void checkMesh(const Element& element, const Mesh& mesh) {
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

void checkNode(const Element& element, const Node& node, std::size_t index, const Scene& scene) {
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

/// Values between keys stay within the bounds of their member, so those of keys need only be numbers.
void checkKeys(const Element& element, const LightKeys& keys) {
    const std::vector<double>& times = keys.timesSeconds;
    const std::string_view name = infoOf(keys.of).name;
    element.require(!times.empty() && times.size() == keys.values.size(),
                    fmt::format("has {} key times for {} keys of its {}; give as many of both, at least one",
                                times.size(), keys.values.size(), name));
    for (std::size_t i = 0; i < times.size(); ++i) {
        element.require(std::isfinite(times[i]) && (i == 0 || times[i] > times[i - 1]), "its key times must ascend");
    }
    element.require(std::isfinite(times.back() - times.front()), "its key times lie too far apart");
    for (const glm::dvec3& value : keys.values) {
        element.require(allFinite(value), fmt::format("a key of its {} is not finite", name));
        element.require(!infoOf(keys.of).isOnSphere || isUnit(value),
                        fmt::format("a key of its {} must be of unit length", name));
        element.require(keys.of != LightKeyed::Position || isNearEnough(value),
                        fmt::format("a key leads more than {:g} m from the origin; keep it nearer", kFarthestMetres));
    }
    if (keys.interpolation != Interpolation::CubicSpline) return;
    element.require(keys.inTangents.size() == times.size() && keys.outTangents.size() == times.size(),
                    fmt::format("has {} in-tangents and {} out-tangents for {} key times; give as many",
                                keys.inTangents.size(), keys.outTangents.size(), times.size()));
    // A spline strays from its keys by less than its tangents lead within the time between two keys.
    const double seconds = std::max(1.0, times.back() - times.front());
    for (const std::vector<glm::dvec3>* tangents : {&keys.inTangents, &keys.outTangents})
        for (const glm::dvec3& tangent : *tangents) {
            element.require(allFinite(tangent * seconds), "a tangent of its keys leads too far; make it shorter");
            element.require(
                keys.of != LightKeyed::Position || isNearEnough(tangent * seconds),
                fmt::format("a tangent of its keys leads more than {:g} m away; make it shorter", kFarthestMetres));
        }
}

void checkAnimation(const Element& element, const LightAnimation& animation) {
    element.require(std::isfinite(animation.periodSeconds) && animation.periodSeconds > 0.0,
                    "the period of its animation must be positive");
    element.require(std::isfinite(animation.phase), "the phase of its animation is not finite");
    element.require(allFinite(animation.centerWS) && allFinite(animation.amplitudeMetres),
                    "its animation's centre and amplitude must be finite");
    element.require(allFinite(animation.axisWS), "its animation's axis is not finite");
    if (animation.kind == LightAnimationKind::Orbit) {
        element.require(glm::length(animation.axisWS) > 0.0, "the axis of its orbit has no length");
    }
    for (const glm::dvec3& pointWS : animation.pointsWS) element.require(allFinite(pointWS), "a point is not finite");
    const auto& points = animation.pointsWS;
    element.require(
        isNearEnough(animation.centerWS) && isNearEnough(animation.amplitudeMetres) &&
            std::all_of(points.begin(), points.end(), isNearEnough),
        fmt::format("its animation leads more than {:g} m from the origin; keep it nearer", kFarthestMetres));
    if (animation.kind == LightAnimationKind::Path) {
        element.require(animation.pointsWS.size() >= 2, "its path needs at least two points");
        element.require(hasLength(animation), "its path has no length; move one of its points");
    }
    if (animation.kind == LightAnimationKind::Keyframes) {
        element.require(animation.keys.of == LightKeyed::Position,
                        "the keyframes of its animation must be of position");
        checkKeys(element, animation.keys);
    }
}

void checkLight(const Element& element, const Light& light) {
    visitFields(kLightFields, [&](const auto& field) {
        if (field.what != nullptr && !isWithin(light.*field.member, field))
            element.require(
                false, fmt::format("{} must be {}{}", field.what, boundsText(field.least, field.most), field.unit));
    });
    element.require(allFinite(light.positionWS), "its position is not finite");
    element.require(isNearEnough(light.positionWS),
                    fmt::format("it lies more than {:g} m from the origin; move it nearer", kFarthestMetres));
    element.require(isUnit(light.directionWS), "its direction must be of unit length");
    element.require(isUnit(light.alongWS), "the direction of its width must be of unit length");
    const LightTypeInfo& info = infoOf(light.type);
    if (info.isTurned())
        element.require(std::abs(glm::dot(light.alongWS, light.directionWS)) <= kUnitTolerance,
                        "the direction of its width must be at right angles to its direction");
    const std::string problem = cornersProblem(light.corners);
    element.require(problem.empty(), "its corners " + problem);
    if (info.isArea && light.falloff != Falloff::InverseSquare)
        element.require(false, fmt::format("a {} light falls off by its shape; it takes no falloff by A B C, only the "
                                           "range of an inverse-square one",
                                           info.name));
    element.require(light.rangeMetres >= 0.0f, "its range must not be negative");
    element.require(light.falloff != Falloff::Attenuation || light.attenuation != glm::vec3(0.0f),
                    "the attenuation coefficients A, B, C are all 0; give at least one");
    element.require(
        light.innerConeRadians <= light.outerConeRadians,
        fmt::format("its inner cone of {:g} radians is wider than its outer cone of {:g} radians; make it narrower",
                    light.innerConeRadians, light.outerConeRadians));
    if (light.animation) checkAnimation(element, *light.animation);
    std::set<LightKeyed> keyed;
    for (const LightKeys& keys : light.keyframes) {
        element.require(keys.of != LightKeyed::Position, "keyframes of its position belong into its animation");
        element.require(keyed.insert(keys.of).second,
                        fmt::format("has keyframes of its {} twice; keep one of them", infoOf(keys.of).name));
        checkKeys(element, keys);
    }
    if (!light.flicker) return;
    const LightFlicker& flicker = *light.flicker;
    element.require(flicker.amplitude >= 0.0 && flicker.amplitude <= 1.0,
                    "the amplitude of its flicker must be between 0 and 1");
    element.require(
        flicker.frequencyHz > 0.0 && flicker.frequencyHz <= LightFlicker::kMostHertz,
        fmt::format("the frequency of its flicker must be above 0 and at most {:g} Hz", LightFlicker::kMostHertz));
    element.require(flicker.seed >= 0, "the seed of its flicker must not be negative");
}

void checkCamera(const Element& element, const Camera& camera) {
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

void checkEnvironment(const Scene& scene, const Environment& environment) {
    const Element element{scene, "environment", 0, environment.map.name};
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

/// All instances of a mesh share its vertices.
void checkMovedMeshes(const Scene& scene, const auto& require) {
    std::vector<std::optional<bool>> moves(scene.meshes.size());
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances) {
            if (instance.mesh == kNone || instance.material == kNone) continue;
            std::optional<bool>& ofMesh = moves[std::size_t(instance.mesh)];
            const bool changes = scene.hook->changes(std::size_t(instance.material));
            require(ofMesh.value_or(changes) == changes,
                    fmt::format("the mesh '{}' is drawn with a material that its hook changes and with one that it "
                                "leaves alone, and its vertices cannot be in two places; give both to the hook",
                                scene.meshes[std::size_t(instance.mesh)].name));
            ofMesh = changes;
        }
}

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
    if (scene.hook) {
        const Hook& hook = *scene.hook;
        const auto isMaterial = [&](int i) { return i >= 0 && std::size_t(i) < scene.materials.size(); };
        require(std::ranges::all_of(hook.materials, isMaterial), "its hook changes a material that is not there");
        require(std::ranges::adjacent_find(hook.materials, std::greater_equal<>()) == hook.materials.end(),
                "the materials that its hook changes must ascend");
        require(hook.parameters.size() <= kMostHookParameters,
                fmt::format("its hook has {} parameters, and at most {} can be given", hook.parameters.size(),
                            kMostHookParameters));
        require(between(hook.mayMoveMetres, 0.0, kFarthestMetres),
                fmt::format("mayMoveMetres of its hook must lie between 0 and {:g}", kFarthestMetres));
        if (hook.movesVertices) checkMovedMeshes(scene, require);
        std::set<std::string_view> names;
        for (const HookParameter& parameter : hook.parameters) {
            require(isHookParameterName(parameter.name) && names.insert(parameter.name).second,
                    fmt::format("'{}' names no parameter of its hook; give letters and digits, each name once",
                                parameter.name));
            require(std::isfinite(parameter.least) && std::isfinite(parameter.most) &&
                        between(double(parameter.value), double(parameter.least), double(parameter.most)),
                    fmt::format("the parameter '{}' of its hook is {:g}, and must lie between {:g} and {:g}",
                                parameter.name, parameter.value, parameter.least, parameter.most));
        }
    }
    const SceneOptions& options = scene.options;
    for (const auto& [key, wish] : options.wishes) {
        const auto* const number = std::get_if<double>(&wish);
        const auto* const list = std::get_if<std::vector<double>>(&wish);
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
        const Element element(scene, "node", i, scene.nodes[i].name);
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
    // Checked here only where nodes carry them; else checkLight() and checkCamera() do. Far scales leave no direction.
    const auto requireNear = [&](bool isNear, std::string_view kind, int index, const std::string& name) {
        if (!isNear)
            Element(scene, kind, std::size_t(index), name)
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
    std::set<const LightPicture*> pictures; // shared by the lights that name them
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
