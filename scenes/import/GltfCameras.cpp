#include "scenes/import/GltfCameras.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace tessera::scenes::gltf {
namespace {

/// Looks where the transform sends -Z, with its +Y as upright as can be, and never mirrored.
glm::dmat4 rigidOf(const glm::dmat4& worldFromNode, bool& isDegenerate) {
    const glm::dvec3 backWS(worldFromNode[2]);
    const glm::dvec3 rightWS = glm::cross(glm::dvec3(worldFromNode[1]), backWS);
    // Relative to the axes' lengths, so that small scales pass; 1e-12 is far above double's rounding.
    const double lengths = glm::length(backWS) * glm::length(glm::dvec3(worldFromNode[1]));
    isDegenerate = !(glm::length(rightWS) > 1e-12 * lengths);
    glm::dmat4 rigid(1.0);
    if (!isDegenerate) {
        rigid[2] = glm::dvec4(glm::normalize(backWS), 0.0);
        rigid[0] = glm::dvec4(glm::normalize(rightWS), 0.0);
        rigid[1] = glm::dvec4(glm::cross(glm::dvec3(rigid[2]), glm::dvec3(rigid[0])), 0.0);
    }
    rigid[3] = worldFromNode[3];
    return rigid;
}

std::string uniqueName(Context& context, const std::string& wanted) {
    std::string name = wanted;
    int& number = context.cameraNumbers.try_emplace(wanted, 1).first->second;
    while (!context.cameraNames.insert(name).second) name = fmt::format("{} {}", wanted, ++number);
    return name;
}

void setPerspective(Context& context, const tinygltf::Camera& stored, const nlohmann::json& written,
                    const std::string& place, Camera& camera) {
    const tinygltf::PerspectiveCamera& lens = stored.perspective;
    if (!(lens.yfov > 0.0 && lens.yfov < std::numbers::pi))
        context.document.fail(place + "/perspective/yfov",
                              fmt::format("is {}; it must be between 0 and pi radians", lens.yfov));
    if (!(lens.znear > 0.0))
        context.document.fail(place + "/perspective/znear",
                              fmt::format("is {}; it must be greater than 0", lens.znear));
    camera.projection = Projection::Perspective;
    camera.fovYRadians = lens.yfov;
    camera.nearMetres = lens.znear;
    if (!written["perspective"].contains("zfar")) return;
    if (!(lens.zfar > lens.znear))
        context.document.fail(place + "/perspective/zfar",
                              fmt::format("is {}; it must be greater than znear {}", lens.zfar, lens.znear));
    camera.farMetres = lens.zfar;
}

void setOrthographic(Context& context, const tinygltf::Camera& stored, const std::string& place, Camera& camera) {
    const tinygltf::OrthographicCamera& lens = stored.orthographic;
    if (lens.ymag == 0.0 || lens.xmag == 0.0)
        context.document.fail(place + "/orthographic", "xmag and ymag must not be 0");
    if (!(lens.znear >= 0.0 && lens.zfar > lens.znear))
        context.document.fail(
            place + "/orthographic",
            fmt::format("has znear {} and zfar {}; needed is 0 <= znear < zfar", lens.znear, lens.zfar));
    camera.projection = Projection::Orthographic;
    camera.halfHeightMetres = std::abs(lens.ymag);
    camera.nearMetres = lens.znear;
    camera.farMetres = lens.zfar;
}

} // namespace

void importCamera(Context& context, int nodeIndex, const glm::dmat4& worldFromNode) {
    const tinygltf::Node& node = context.document.model.nodes[static_cast<std::size_t>(nodeIndex)];
    if (node.camera < 0) return;
    const std::string place = fmt::format("/cameras/{}", node.camera);
    const tinygltf::Camera& stored = context.document.model.cameras[static_cast<std::size_t>(node.camera)];
    const nlohmann::json& written = context.document.json["cameras"][static_cast<std::size_t>(node.camera)];

    Camera camera;
    camera.name = uniqueName(context, !stored.name.empty() ? stored.name : nameOr(node.name, "camera", node.camera));
    bool isDegenerate = false;
    camera.worldFromCamera = rigidOf(worldFromNode, isDegenerate);
    if (isDegenerate)
        context.warn(fmt::format("/nodes/{}: its scale of zero leaves camera '{}' no direction; it looks along -Z",
                                 nodeIndex, camera.name));
    if (stored.type == "perspective")
        setPerspective(context, stored, written, place, camera);
    else
        setOrthographic(context, stored, place, camera);
    context.scene.cameras.push_back(std::move(camera));
}

} // namespace tessera::scenes::gltf
