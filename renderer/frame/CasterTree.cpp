#include "renderer/frame/CasterTree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "base/Median.h"
#include "scenes/Shadows.h"

namespace tessera::frame {

namespace {

using scenes::Material;
using scenes::Mesh;

// ---- Triangles -----------------------------------------------------------------------------------------------------

struct CasterCorner {
    glm::vec3 positionCS;
    glm::vec2 texCoord; ///< the texture's transform applied
    float opacity;      ///< base colour factor times vertex colour, without the texture
};

struct CasterTriangle {
    std::array<CasterCorner, 3> corners;
    const Material* mask; ///< null: fully opaque
    std::uint32_t mark;   ///< packed CASTER_PASSED and CASTER_MIRRORED
};

/// offset + rotation(scale uv), after KHR_texture_transform.
glm::vec2 placed(const scenes::TextureTransform& transform, const glm::vec2& uv) {
    const double sine = std::sin(double(transform.rotationRadians)),
                 cosine = std::cos(double(transform.rotationRadians));
    const glm::dvec2 scaled = glm::dvec2(transform.scale) * glm::dvec2(uv);
    return glm::vec2(glm::dvec2(transform.offset) +
                     glm::dvec2(cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x));
}

CasterCorner cornerOf(const Mesh& mesh, const Material& material, std::uint32_t vertex, const glm::dvec3& positionCS) {
    CasterCorner corner{glm::vec3(positionCS), glm::vec2(0.0f), material.baseColor.w};
    if (!mesh.colors.empty()) corner.opacity *= mesh.colors[vertex].w;
    const scenes::TextureUse& use = material.texture(scenes::TextureSlot::BaseColor);
    const std::vector<glm::vec2>& texCoords = mesh.texCoords[std::size_t(use.texCoordSet)];
    if (!texCoords.empty()) corner.texCoord = placed(use.transform, texCoords[vertex]);
    return corner;
}

bool hasArea(const CasterTriangle& triangle) {
    const glm::dvec3 a(triangle.corners[0].positionCS);
    return glm::cross(glm::dvec3(triangle.corners[1].positionCS) - a, glm::dvec3(triangle.corners[2].positionCS) - a) !=
           glm::dvec3(0.0);
}

/// Rotates the corners so that the first lies between the two shorter edges. In a thin triangle their cross product
/// keeps more digits than that of a long edge.
void turnToShortEdges(CasterTriangle& triangle) {
    const auto opposite = [&](std::size_t corner) {
        return glm::distance(glm::dvec3(triangle.corners[(corner + 1) % 3].positionCS),
                             glm::dvec3(triangle.corners[(corner + 2) % 3].positionCS));
    };
    std::size_t first = 0;
    for (std::size_t corner = 1; corner < 3; ++corner)
        if (opposite(corner) > opposite(first)) first = corner;
    std::rotate(triangle.corners.begin(), triangle.corners.begin() + std::ptrdiff_t(first), triangle.corners.end());
}

/// Calls `visit` with each caster's mesh, material and transform.
template <typename Visit>
void visitCasters(const scenes::Scene& scene, Visit visit) {
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances)
            if (scenes::isCaster(scene, instance))
                visit(scene.meshes[std::size_t(instance.mesh)], scene.materials[std::size_t(instance.material)],
                      worldFromNode[node]);
}

glm::dvec3 placeOf(const glm::dmat4& worldFromNode, const glm::vec3& positionOS) {
    return glm::dvec3(worldFromNode * glm::dvec4(glm::dvec3(positionOS), 1.0));
}

/// Rounding error of a mesh's triangles in metres, beyond kPositionRounding times their distance from `centreWS`. A
/// vertex is a sum of products of its mesh coordinates, and its error moves the whole triangle.
double roundingMetresOf(const Mesh& mesh, const glm::dmat4& worldFromNode, const glm::dvec3& centreWS) {
    double metres = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        glm::dvec3 corners[3];
        double reach = 0.0, farthest = 0.0, longest = 0.0;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 positionOS(mesh.positionsOS[mesh.indices[i + corner]]);
            corners[corner] = placeOf(worldFromNode, positionOS) - centreWS;
            farthest = std::max(farthest, glm::length(corners[corner]));
            glm::dvec3 products;
            for (int axis = 0; axis < 3; ++axis)
                products[axis] = glm::length(glm::dvec3(worldFromNode[axis])) * positionOS[axis];
            reach = std::max({reach, glm::length(products), glm::length(corners[corner])});
        }
        for (std::size_t corner = 0; corner < 3; ++corner)
            longest = std::max(longest, glm::distance(corners[corner], corners[(corner + 1) % 3]));
        metres = std::max(metres, kPositionRounding * (reach - std::max(farthest - longest, 0.0)));
    }
    return metres;
}

/// Fills all of CasterSpace except `nodes`. unitMetres is 0 without casters or if all their corners coincide.
CasterSpace spaceOf(const scenes::Scene& scene) {
    // Collects one coordinate of each corner at a time to save memory: scenes may have many corners.
    const auto ofCorners = [&](auto number) {
        std::vector<double> numbers;
        visitCasters(scene, [&](const Mesh& mesh, const Material&, const glm::dmat4& worldFromNode) {
            for (const std::uint32_t vertex : mesh.indices)
                numbers.push_back(number(placeOf(worldFromNode, mesh.positionsOS[vertex])));
        });
        return numbers;
    };
    CasterSpace space;
    for (int axis = 0; axis < 3; ++axis)
        space.centreWS[axis] = medianOf(ofCorners([axis](const glm::dvec3& placeWS) { return placeWS[axis]; }));
    std::vector<double> distances =
        ofCorners([&](const glm::dvec3& placeWS) { return glm::distance(placeWS, space.centreWS); });
    const double farthest = distances.empty() ? 0.0 : *std::ranges::max_element(distances);
    // Geometric mean of the median and the largest distance: fp32 holds the fourth powers of both up to a ratio of
    // 10^18.
    const double usual = medianOf(std::move(distances));
    space.unitMetres = usual > 0.0 ? std::sqrt(usual) * std::sqrt(farthest) : farthest;
    if (space.unitMetres == 0.0) return space;
    space.radius = farthest / space.unitMetres;
    // All instances count: surfaces that cast no shadow still receive shadows.
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances)
            space.roundingMetres =
                std::max(space.roundingMetres, roundingMetresOf(scene.meshes[std::size_t(instance.mesh)],
                                                                worldFromNode[node], space.centreWS));
    return space;
}

/// The casters' triangles: [0] opaque, [1] alpha-masked.
std::array<std::vector<CasterTriangle>, 2> trianglesOf(const scenes::Scene& scene, const CasterSpace& space,
                                                       std::span<const std::size_t> passedRows) {
    std::array<std::vector<CasterTriangle>, 2> triangles;
    visitCasters(scene, [&](const Mesh& mesh, const Material& material, const glm::dmat4& worldFromNode) {
        const bool isMasked = material.alphaMode == scenes::AlphaMode::Mask;
        const std::size_t number = std::size_t(&material - scene.materials.data());
        const bool isMirrored = glm::determinant(glm::dmat3(worldFromNode)) < 0.0;
        const std::uint32_t mark =
            (number < passedRows.size() ? std::uint32_t(passedRows[number]) : 0u) | (isMirrored ? CASTER_MIRRORED : 0u);
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            CasterTriangle triangle{{}, isMasked ? &material : nullptr, mark};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = mesh.indices[i + corner];
                triangle.corners[corner] =
                    cornerOf(mesh, material, vertex,
                             (placeOf(worldFromNode, mesh.positionsOS[vertex]) - space.centreWS) / space.unitMetres);
            }
            if (!hasArea(triangle)) continue;
            turnToShortEdges(triangle);
            triangles[isMasked].push_back(triangle);
        }
    });
    return triangles;
}

// ---- Building the hierarchy with Embree ----------------------------------------------------------------------------

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseTree {
    void operator()(RTCBVH tree) const { rtcReleaseBVH(tree); }
};

/// A node as Embree's builder makes it.
struct BuiltNode {
    std::array<RTCBounds, 2> bounds{};
    std::array<const BuiltNode*, 2> children{}; ///< null: a leaf
    std::array<std::uint32_t, CASTER_LEAF_MOST> triangles{};
    std::uint32_t count = 0;
};

BuiltNode* makeNode(RTCThreadLocalAllocator allocator) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), alignof(BuiltNode))) BuiltNode;
}

RTCBuildPrimitive primitiveOf(const CasterTriangle& triangle, std::uint32_t number) {
    glm::vec3 low = triangle.corners[0].positionCS, high = low;
    for (const CasterCorner& corner : triangle.corners) {
        low = glm::min(low, corner.positionCS);
        high = glm::max(high, corner.positionCS);
    }
    return {low.x, low.y, low.z, 0, high.x, high.y, high.z, number};
}

[[noreturn]] void fail(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    throw std::runtime_error(
        error == RTC_ERROR_OUT_OF_MEMORY || error == RTC_ERROR_NONE
            ? "out of memory while the casters of shadows are sorted; give --shadows none"
            : fmt::format("Embree failed while it sorted the casters of shadows (error {})", int(error)));
}

/// Writes the texels of the tree.
class TreeWriter {
public:
    TreeWriter(const scenes::Scene& scene, CasterTree& tree) : scene_(scene), tree_(tree) {}

    /// Writes all nodes first, so that a node's number is its place in the buffer.
    void write(const std::array<std::vector<CasterTriangle>, 2>& triangles) {
        const std::unique_ptr<RTCDeviceTy, ReleaseDevice> device(rtcNewDevice(nullptr));
        if (!device) throw std::runtime_error("Embree, which sorts the casters of shadows, does not start");
        for (const std::vector<CasterTriangle>& list : triangles)
            if (!list.empty()) sort(device.get(), list);
        tree_.space.nodes = std::uint32_t(nodes_.size() / CASTER_NODE_TEXELS);
        std::size_t texels = nodes_.size();
        for (const Leaf& leaf : leaves_) texels += leaf.triangles.size() * triangleTexels(leaf);
        if (texels >= std::size_t(1) << CASTER_LEAF_TEXEL_BITS)
            throw std::runtime_error(
                "the casters of shadows have too many triangles for one buffer; give --shadows none");
        tree_.texels = std::move(nodes_);
        for (const Leaf& leaf : leaves_) writeLeaf(leaf);
        for (const Pending& pending : pending_) tree_.texels[pending.texel].z = maskOf(*pending.material);
    }

private:
    struct Leaf {
        std::size_t nodeTexel; ///< node texel that stores packCasterLeaf()
        std::vector<const CasterTriangle*> triangles;
    };
    /// A triangle's texel whose z receives the first texel of its mask, written last.
    struct Pending {
        std::size_t texel;
        const Material* material;
    };

    static std::size_t triangleTexels(const Leaf& leaf) {
        return leaf.triangles.front()->mask ? CASTER_MASKED_TRIANGLE_TEXELS : CASTER_TRIANGLE_TEXELS;
    }

    void sort(RTCDevice device, const std::vector<CasterTriangle>& triangles) {
        std::vector<RTCBuildPrimitive> primitives;
        primitives.reserve(triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i)
            primitives.push_back(primitiveOf(triangles[i], std::uint32_t(i)));
        const RTCBounds all = boundsOf(primitives);
        const std::unique_ptr<RTCBVHTy, ReleaseTree> tree(rtcNewBVH(device));
        RTCBuildArguments arguments = rtcDefaultBuildArguments();
        arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
        arguments.maxBranchingFactor = 2;
        arguments.maxLeafSize = CASTER_LEAF_MOST;
        arguments.bvh = tree.get();
        arguments.primitives = primitives.data();
        arguments.primitiveCount = primitives.size();
        arguments.primitiveArrayCapacity = primitives.size();
        arguments.createNode = [](RTCThreadLocalAllocator allocator, unsigned, void*) -> void* {
            return makeNode(allocator);
        };
        arguments.setNodeChildren = [](void* node, void** children, unsigned count, void*) {
            for (unsigned i = 0; i < count; ++i)
                static_cast<BuiltNode*>(node)->children[i] = static_cast<const BuiltNode*>(children[i]);
        };
        arguments.setNodeBounds = [](void* node, const RTCBounds** bounds, unsigned count, void*) {
            for (unsigned i = 0; i < count; ++i) static_cast<BuiltNode*>(node)->bounds[i] = *bounds[i];
        };
        arguments.createLeaf = [](RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* first, std::size_t count,
                                  void*) -> void* {
            BuiltNode* leaf = makeNode(allocator);
            for (std::size_t i = 0; i < count; ++i) leaf->triangles[i] = first[i].primID;
            leaf->count = std::uint32_t(count);
            return leaf;
        };
        const auto* root = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
        if (root == nullptr) fail(device);
        add(*root, all, triangles);
    }

    static RTCBounds boundsOf(const std::vector<RTCBuildPrimitive>& primitives) {
        RTCBounds all{};
        const RTCBuildPrimitive& first = primitives.front();
        all.lower_x = first.lower_x, all.lower_y = first.lower_y, all.lower_z = first.lower_z;
        all.upper_x = first.upper_x, all.upper_y = first.upper_y, all.upper_z = first.upper_z;
        for (const RTCBuildPrimitive& primitive : primitives) {
            all.lower_x = std::min(all.lower_x, primitive.lower_x);
            all.lower_y = std::min(all.lower_y, primitive.lower_y);
            all.lower_z = std::min(all.lower_z, primitive.lower_z);
            all.upper_x = std::max(all.upper_x, primitive.upper_x);
            all.upper_y = std::max(all.upper_y, primitive.upper_y);
            all.upper_z = std::max(all.upper_z, primitive.upper_z);
        }
        return all;
    }

    /// Adds a node and its subtree recursively. Embree's trees are at most a few dozen levels deep.
    void add(const BuiltNode& built, const RTCBounds& bounds, const std::vector<CasterTriangle>& triangles) {
        const std::size_t texel = nodes_.size();
        nodes_.emplace_back(glm::floatBitsToUint(glm::vec3(bounds.lower_x, bounds.lower_y, bounds.lower_z)), 0u);
        nodes_.emplace_back(glm::floatBitsToUint(glm::vec3(bounds.upper_x, bounds.upper_y, bounds.upper_z)), 0u);
        if (built.count > 0) {
            Leaf leaf{texel + 1, {}};
            for (std::uint32_t i = 0; i < built.count; ++i) leaf.triangles.push_back(&triangles[built.triangles[i]]);
            leaves_.push_back(std::move(leaf));
        } else {
            for (std::size_t i = 0; i < 2; ++i)
                if (built.children[i] != nullptr) add(*built.children[i], built.bounds[i], triangles);
        }
        nodes_[texel].w = glm::uint(nodes_.size() / CASTER_NODE_TEXELS);
    }

    void writeLeaf(const Leaf& leaf) {
        const bool isMasked = leaf.triangles.front()->mask != nullptr;
        tree_.texels[leaf.nodeTexel].w =
            shared::packCasterLeaf(glm::uint(tree_.texels.size()), glm::uint(leaf.triangles.size()), isMasked);
        for (const CasterTriangle* triangle : leaf.triangles) {
            const std::array<CasterCorner, 3>& corners = triangle->corners;
            const std::size_t first = tree_.texels.size();
            for (const CasterCorner& corner : corners)
                tree_.texels.push_back(glm::floatBitsToUint(glm::vec4(corner.positionCS, corner.opacity)));
            if (!isMasked) {
                tree_.texels[first].w = triangle->mark;
                continue;
            }
            tree_.texels.push_back(glm::floatBitsToUint(glm::vec4(corners[0].texCoord, corners[1].texCoord)));
            pending_.push_back({tree_.texels.size(), triangle->mask});
            tree_.texels.emplace_back(glm::floatBitsToUint(corners[2].texCoord), 0u, triangle->mark);
        }
    }

    /// Returns the first texel of a material's mask, and writes the mask on first use.
    glm::uint maskOf(const Material& material) {
        const auto [known, isNew] = masks_.try_emplace(&material, glm::uint(tree_.texels.size()));
        if (!isNew) return known->second;
        const glm::uint texel = known->second;
        const scenes::TextureUse& use = material.texture(scenes::TextureSlot::BaseColor);
        const bool isNearest = use.sampler.magnification == scenes::Filter::Nearest;
        const glm::uint reading = glm::uint(use.sampler.wrapU) << CASTER_MASK_WRAP_U_SHIFT |
                                  glm::uint(use.sampler.wrapV) << CASTER_MASK_WRAP_V_SHIFT |
                                  (isNearest ? CASTER_MASK_NEAREST : 0u);
        tree_.texels.resize(tree_.texels.size() + CASTER_MASK_TEXELS);
        const scenes::Image* image = use.image == scenes::kNone ? nullptr : &scene_.images[std::size_t(use.image)];
        const auto [first, isNewImage] = opacities_.try_emplace(use.image, glm::uint(tree_.texels.size()));
        if (isNewImage) writeOpacities(image);
        const glm::uvec2 size = image ? glm::uvec2(image->width, image->height) : glm::uvec2(1u);
        tree_.texels[texel] = glm::uvec4(first->second, size, reading);
        tree_.texels[texel + 1] = glm::uvec4(std::bit_cast<glm::uint>(material.alphaCutoff), 0u, 0u, 0u);
        return texel;
    }

    /// Writes the alpha channel of an image, or a single 1 without an image.
    void writeOpacities(const scenes::Image* image) {
        std::vector<float> opacities(image ? std::size_t(image->width) * std::size_t(image->height) : 1, 1.0f);
        if (image) {
            const std::size_t bytes = scenes::texelBytes(image->format);
            for (std::size_t i = 0; i < opacities.size(); ++i)
                opacities[i] = opacityOf(image->format, &image->texels[i * bytes]);
        }
        opacities.resize((opacities.size() + 3) / 4 * 4);
        if (tree_.texels.size() + opacities.size() / 4 >= std::size_t(1) << 31)
            throw std::runtime_error("the masks of casters have too many texels for one buffer; give --shadows none");
        for (std::size_t i = 0; i < opacities.size(); i += 4)
            tree_.texels.push_back(
                glm::floatBitsToUint(glm::vec4(opacities[i], opacities[i + 1], opacities[i + 2], opacities[i + 3])));
    }

    static float opacityOf(scenes::TexelFormat format, const std::byte* texel) {
        switch (format) {
        case scenes::TexelFormat::Rgba8Unorm:
            return float(std::to_integer<int>(texel[3])) / 255.0f;
        case scenes::TexelFormat::Rgba16Unorm: {
            std::uint16_t code = 0;
            std::memcpy(&code, texel + 3 * sizeof code, sizeof code);
            return float(code) / 65535.0f;
        }
        case scenes::TexelFormat::Rgba32Float:
            break;
        }
        float value = 0.0f;
        std::memcpy(&value, texel + 3 * sizeof value, sizeof value);
        return value;
    }

    const scenes::Scene& scene_;
    CasterTree& tree_;
    std::vector<glm::uvec4> nodes_;
    std::vector<Leaf> leaves_;
    std::vector<Pending> pending_;
    std::map<const Material*, glm::uint> masks_;
    std::map<int, glm::uint> opacities_; ///< first texel, by image
};

static_assert(int(scenes::Wrap::ClampToEdge) == CASTER_WRAP_CLAMP &&
              int(scenes::Wrap::MirroredRepeat) == CASTER_WRAP_MIRROR);

} // namespace

CasterTree makeCasterTree(const scenes::Scene& scene, std::span<const std::size_t> passedRows) {
    CasterTree tree;
    tree.space = spaceOf(scene);
    if (tree.space.unitMetres == 0.0) return tree;
    const std::array<std::vector<CasterTriangle>, 2> triangles = trianglesOf(scene, tree.space, passedRows);
    if (triangles[0].empty() && triangles[1].empty()) return tree;
    TreeWriter(scene, tree).write(triangles);
    return tree;
}

shared::CasterTreeConstants casterTreeConstants(const CasterSpace& casters, const CameraView& view) {
    shared::CasterTreeConstants constants{};
    constants.size = glm::uvec4(casters.nodes, 0u, 0u, 0u);
    if (casters.nodes == 0) return constants;
    const glm::dvec3 fromCentreMetres = view.originWS - casters.centreWS;
    constants.rwsOriginCS =
        glm::vec4(glm::vec3(fromCentreMetres / casters.unitMetres), float(1.0 / casters.unitMetres));
    // Covers the offset between the two origins and the linear depth steps. From the casters' origin, a corner is at
    // most as far as the point plus the distance between the two, whose rounding the walk adds.
    const double metres = kPositionRounding * (glm::length(fromCentreMetres) + double(view.constants.depthKey.y)) +
                          casters.roundingMetres;
    constants.rounding = glm::vec4(float(metres), float(2.0 * kPositionRounding), float(casters.radius), 0.0f);
    return constants;
}

} // namespace tessera::frame
