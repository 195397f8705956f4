#include "scenes/import/GltfSteps.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "scenes/Transform.h"

namespace tessera::scenes::gltf {
namespace {

constexpr std::size_t kCopies = 2; ///< while a vector grows

std::string uniqueName(Context& context, const std::string& wanted) {
    std::string name = wanted;
    int& number = context.cameraNumbers.try_emplace(wanted, 1).first->second;
    while (!context.cameraNames.insert(name).second) name = fmt::format("{} {}", wanted, ++number);
    return name;
}

/// `least` is the smallest near plane.
void setRange(const Document& document, double nearMetres, double farMetres, double least, const std::string& place,
              Camera& camera) {
    if (nearMetres >= least && nearMetres <= kFarthestMetres && farMetres > nearMetres) {
        camera.nearMetres = nearMetres;
        camera.farMetres = farMetres;
    } else {
        document.repair(place, "what it sees has no end",
                        "has znear {} and zfar {}; znear must be {} 0 and less than zfar", nearMetres, farMetres,
                        least > 0.0 ? "more than" : "at least");
    }
}

void setPerspective(const Document& document, const tiny::PerspectiveCamera& lens, const std::string& place,
                    Camera& camera) {
    if (lens.yfov > 0.0 && lens.yfov < std::numbers::pi)
        camera.fovYRadians = lens.yfov;
    else
        document.repair(place + "/perspective/yfov", "pi/4 is taken", "is {}; it must be between 0 and pi radians",
                        lens.yfov);
    const double far = lens.zfar > 0.0 ? lens.zfar : std::numeric_limits<double>::infinity();
    setRange(document, lens.znear, far, kNearestPlaneMetres, place + "/perspective", camera);
}

void setOrthographic(const Document& document, const tiny::OrthographicCamera& lens, const std::string& place,
                     Camera& camera) {
    if (lens.ymag != 0.0 && std::abs(lens.ymag) <= kFarthestMetres)
        camera.halfHeightMetres = std::abs(lens.ymag);
    else
        document.repair(place + "/orthographic/ymag", "1 is taken", "is {}", lens.ymag);
    setRange(document, lens.znear, lens.zfar, 0.0, place + "/orthographic", camera);
}

LightType typeOf(const tiny::Light& light) {
    if (light.type == "directional") return LightType::Directional;
    return light.type == "point" ? LightType::Point : LightType::Spot;
}

/// Equal angles give a cone with a hard edge. The extension forbids them; Blender writes them for a spot without blend.
void setCones(const Document& document, const tiny::SpotLight& stored, const std::string& place, Light& light) {
    constexpr double kWidestRadians = std::numbers::pi / 2.0;
    // Exporters round pi/2 up to float; a millionth of a radian covers that and is invisible.
    constexpr double kRoundingRadians = 1e-6;
    double outer = stored.outerConeAngle;
    if (outer > kWidestRadians + kRoundingRadians) {
        document.repair(place + "/spot/outerConeAngle", "pi/2 is taken", "is {}; it must be at most pi/2 radians",
                        stored.outerConeAngle);
        outer = kWidestRadians;
    }
    if (stored.innerConeAngle > outer)
        document.repair(place + "/spot/innerConeAngle", "the outer angle is taken",
                        "is {}; it must be less than the outer angle, {}", stored.innerConeAngle, outer);
    light.innerConeRadians = float(std::min(stored.innerConeAngle, outer));
    light.outerConeRadians = float(outer);
}

// ---- Units of lights ------------------------------------------------------------------------------------------------

using ExporterVersion = std::pair<int, int>; ///< major, minor

/// Version of Blender's exporter, from a text such as "Khronos glTF Blender I/O v4.2.57"; 0.0 if it has no number.
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

void importCamera(Context& context, int nodeIndex, const glm::dmat4& worldFromNode) {
    const Document& document = context.document;
    const tiny::Node& node = elementAt(document.model.nodes, nodeIndex);
    if (node.camera == kNone) return;
    const std::string place = fmt::format("/cameras/{}", node.camera);
    const tiny::Camera& stored = elementAt(document.model.cameras, node.camera);

    Camera camera;
    camera.name = uniqueName(context, !stored.name.empty() ? stored.name : nameOr(node.name, "camera", node.camera));
    document.charge(kCopies * (sizeof(Camera) + camera.name.size()), "nodes", nodeIndex);
    bool isDegenerate = false;
    camera.worldFromCamera = rigidOf(worldFromNode, isDegenerate);
    if (isDegenerate)
        context.warn("/nodes/{}: its scale of zero leaves camera '{}' no direction; it looks along -Z", nodeIndex,
                     camera.name);
    camera.projection = stored.type == "perspective" ? Projection::Perspective : Projection::Orthographic;
    if (camera.projection == Projection::Perspective)
        setPerspective(document, stored.perspective, place, camera);
    else
        setOrthographic(document, stored.orthographic, place, camera);
    context.scene.cameras.push_back(std::move(camera));
}

void importLight(Context& context, int nodeIndex, const glm::dmat4& worldFromNode) {
    const Document& document = context.document;
    const int index = lightOf(elementAt(document.model.nodes, nodeIndex));
    if (index == kNone) return;
    const auto at = std::size_t(index);
    const std::string place = fmt::format("/extensions/KHR_lights_punctual/lights/{}", index);
    const tiny::Light& stored = document.model.lights[at];

    Light light;
    light.name = nameOr(stored.name, "light", index);
    document.charge(kCopies * (sizeof(Light) + light.name.size()), "nodes", nodeIndex);
    light.type = typeOf(stored);
    light.color = vectorOf(stored.color, glm::vec3(1.0f));
    light.intensity = float(float(stored.intensity) * document.wattsPerUnit[at]);
    light.falloff = Falloff::InverseSquare;
    if (!placeAtNode(light, worldFromNode) && infoOf(light.type).hasDirection)
        context.warn("/nodes/{}: its scale of zero leaves light '{}' no direction; -Z is used", nodeIndex, light.name);
    if (infoOf(light.type).hasPosition()) {
        const auto values = elementsOf(valueAt(document.model.extensions, "KHR_lights_punctual/lights"));
        // three.js writes 0 for an unlimited range.
        if (float(stored.range) > 0.0f)
            light.rangeMetres = float(stored.range);
        else if (values[at].Has("range"))
            document.repair(place + "/range", "the light has no end", "is 0; it must be greater than 0");
    }
    if (light.type == LightType::Spot) setCones(document, stored.spot, place, light);
    context.scene.lights.push_back(std::move(light));
}

void takeLightUnits(Document& document, std::vector<std::string>& notes) {
    if (document.model.lights.empty()) return;
    const std::optional<LightUnits> requested = document.ledger.importOptions().lightUnits;
    const std::optional<ExporterVersion> blender = blenderVersion(document.model.asset.generator);
    if (!(requested ? requested == LightUnits::Lumen : blender.has_value())) return;
    constexpr ExporterVersion kSunsToo{3, 4};
    bool areDivided = false;
    for (std::size_t i = 0; i < document.model.lights.size(); ++i) {
        const bool isWatts = !requested && document.model.lights[i].type == "directional" && *blender < kSunsToo;
        if (isWatts) continue;
        areDivided = true;
        document.wattsPerUnit[i] = 1.0 / kLumensPerWatt;
    }
    if (!requested && areDivided)
        notes.push_back(fmt::format("its lights are in lumens, {} for each watt, as Blender exports them, and shown in "
                                    "watts; --light-units watt takes them as they are",
                                    kLumensPerWatt));
}

} // namespace tessera::scenes::gltf
