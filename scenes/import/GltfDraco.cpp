#include "scenes/import/GltfBuffers.h"

#include <cstring>
#include <exception>
#include <limits>

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

namespace tessera::scenes::gltf {
namespace {

// Peak memory of the decoder, counted in the sources of Draco 1.5.5 and rounded up.
constexpr std::uint64_t kDracoCornerBytes = 80; ///< the corner table, the faces and the maps between them
constexpr std::uint64_t kSeamCornerBytes = 40;  ///< the corner table of an attribute with seams
constexpr std::uint64_t kPointBytes = 32;       ///< the maps from points to an attribute's values
constexpr std::uint64_t kPortableBytes = 8;     ///< a component as an integer, and its prediction
constexpr std::uint64_t kTableBytes = 8u << 20; ///< the decoder's tables of symbols, at most 2^20 entries
constexpr std::uint64_t kMetadataRatio = 64;    ///< heap bytes per byte of metadata
constexpr std::size_t kMostComponents = 16;     ///< of an accessor's element
constexpr std::string_view kBroken = "is broken or cut short";

/// Whether an accessor may have this component type.
bool isComponentType(draco::DataType type) {
    return (type >= draco::DT_INT8 && type <= draco::DT_UINT32) || type == draco::DT_FLOAT32;
}

/// Memory of a stream's points while they are decoded; the portable components are freed afterwards.
std::uint64_t pointBytes(const draco::PointCloud& points) {
    std::uint64_t bytesEach = 0; // per point; includes unused attributes of the stream
    for (int i = 0; i < points.num_attributes(); ++i) {
        const draco::PointAttribute& stored = *points.attribute(i);
        const auto componentBytes = std::uint64_t(draco::DataTypeLength(stored.data_type()));
        bytesEach += kPointBytes + stored.num_components() * (componentBytes + kPortableBytes);
    }
    const std::uint64_t count = points.num_points(), most = std::numeric_limits<std::uint64_t>::max();
    return count > 0 && bytesEach > most / count ? most : count * bytesEach;
}

/// Identifiers in the stream, by attribute name.
std::map<std::string, int> attributesOf(const tiny::Primitive& primitive) {
    return integersByName(valueAt(dracoOf(primitive), "attributes"));
}

int viewOf(const tiny::Primitive& primitive) {
    return integerOf(valueAt(dracoOf(primitive), "bufferView"));
}

/// Checks of the sizes that a stream claims, before Draco allocates memory for them.
class Claims {
public:
    Claims(const Document& document, const tiny::Primitive& primitive, const std::string& place)
        : document_(document), primitive_(primitive), place_(place) {}

    /// Called at the head of a stream's triangles. Throws InputError with the reason.
    void checkTriangles(std::uint64_t faces, std::uint64_t seamTables) const {
        compareTriangles(faces);
        charge(3 * faces * (kDracoCornerBytes + seamTables * kSeamCornerBytes));
    }

    /// Called when all attributes are known, before their values are read. Throws InputError with the reason.
    void checkAttributes(const draco::PointCloud& points) const {
        compareAttributes(points);
        charge(pointBytes(points));
    }

    /// Throws InputError if the accessors contradict the stream.
    void compareTriangles(std::uint64_t faces) const {
        if (primitive_.indices != kNone && accessor(primitive_.indices).count != 3 * faces)
            throw InputError(fmt::format("holds {} triangles, but accessor {} says {} indices", faces,
                                         primitive_.indices, accessor(primitive_.indices).count));
    }
    void compareAttributes(const draco::PointCloud& points) const {
        for (const auto& [name, id] : attributesOf(primitive_)) {
            const auto named = primitive_.attributes.find(name);
            if (named == primitive_.attributes.end()) continue;
            const tiny::Accessor& wanted = accessor(named->second);
            const draco::PointAttribute* stored = points.GetAttributeByUniqueId(std::uint32_t(id));
            if (stored == nullptr) throw InputError(fmt::format("holds no attribute {}, which {} names", id, name));
            if (!isComponentType(stored->data_type()))
                throw InputError(fmt::format("holds {} in a component type that glTF does not have", name));
            if (points.num_points() != wanted.count)
                throw InputError(fmt::format("holds {} vertices, but accessor {} of {} says {}", points.num_points(),
                                             named->second, name, wanted.count));
            if (stored->num_components() != componentsOf(wanted))
                throw InputError(fmt::format("holds {} with {} components an element, but accessor {} says {}", name,
                                             stored->num_components(), named->second, componentsOf(wanted)));
        }
    }

    void charge(std::uint64_t bytes) const { document_.charge(bytes, place_); }

private:
    const tiny::Accessor& accessor(int index) const { return elementAt(document_.model.accessors, index); }

    const Document& document_;
    const tiny::Primitive& primitive_;
    const std::string& place_;
};

/// A Draco decoder that checks the claims while decoding. Exceptions are rethrown after Draco has returned, which may
/// be built without them.
template <typename Decoder, bool kIsEdgebreaker>
class CheckedDecoder : public Decoder {
public:
    explicit CheckedDecoder(const Claims& claims) : claims_(claims) {}

    void decode(draco::DecoderBuffer& stream, draco::Mesh& mesh) {
        const draco::Status status = this->Decode(draco::DecoderOptions(), &stream, &mesh);
        if (failure_) std::rethrow_exception(failure_);
        if (!status.ok()) throw InputError(fmt::format("{} ({})", kBroken, status.error_msg_string()));
    }

protected:
    bool DecodeConnectivity() override {
        return isGood([&] { checkHead(*this->buffer()); }) && Decoder::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override {
        return isGood([&] { claims_.checkAttributes(*this->point_cloud()); }) && Decoder::DecodeAllAttributes();
    }

private:
    /// Reads the claimed number of faces and, for Edgebreaker (after the traversal type), of attributes with separate
    /// corner tables. Source: Draco bitstream specification 2.2, "Connectivity".
    void checkHead(const draco::DecoderBuffer& stream) const {
        draco::DecoderBuffer head; // separate read position
        head.Init(stream.data_head(), std::size_t(stream.remaining_size()), stream.bitstream_version());
        std::uint8_t seamTables = 0;
        std::uint32_t vertices = 0, faces = 0;
        const bool isWhole = (!kIsEdgebreaker || draco::DecodeVarint(&vertices, &head)) &&
                             draco::DecodeVarint(&faces, &head) && (!kIsEdgebreaker || head.Decode(&seamTables));
        if (!isWhole) throw InputError(std::string(kBroken));
        claims_.checkTriangles(faces, seamTables);
    }

    template <typename Check>
    bool isGood(Check check) {
        try {
            check();
            return true;
        } catch (...) {
            failure_ = std::current_exception();
            return false;
        }
    }

    const Claims& claims_;
    std::exception_ptr failure_;
};

/// Decodes a stream. Throws InputError with the reason.
void decodeStream(std::span<const std::byte> bytes, const Claims& claims, draco::Mesh& mesh) {
    draco::DecoderBuffer stream;
    stream.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DecoderBuffer head;
    head.Init(stream.data_head(), bytes.size());
    draco::DracoHeader header;
    if (const draco::Status status = draco::PointCloudDecoder::DecodeHeader(&head, &header); !status.ok())
        throw InputError(fmt::format("is no stream of Draco ({})", status.error_msg_string()));
    if (header.encoder_type != draco::TRIANGULAR_MESH) throw InputError("is of points, not of a mesh");
    if (header.version_major != draco::kDracoMeshBitstreamVersionMajor ||
        header.version_minor != draco::kDracoMeshBitstreamVersionMinor)
        throw InputError(fmt::format("is of version {}.{} of Draco's format; 2.2 is glTF's", header.version_major,
                                     header.version_minor));
    claims.charge(kTableBytes);
    if ((header.flags & METADATA_FLAG_MASK) != 0) claims.charge(kMetadataRatio * bytes.size());
    if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING)
        CheckedDecoder<draco::MeshSequentialDecoder, false>(claims).decode(stream, mesh);
    else if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
        CheckedDecoder<draco::MeshEdgebreakerDecoder, true>(claims).decode(stream, mesh);
    else
        throw InputError(fmt::format("is of the unknown method {}", header.encoder_method));
}

bool convertPoint(const draco::PointAttribute& stored, draco::AttributeValueIndex value, const tiny::Accessor& wanted,
                  std::byte* to) {
    const auto components = std::size_t(componentsOf(wanted));
    return withComponent(wanted.componentType, [&]<typename Component>(Component) {
        std::array<Component, kMostComponents> converted{};
        if (!stored.ConvertValue<Component>(value, std::int8_t(components), converted.data())) return false;
        std::memcpy(to, converted.data(), components * sizeof(Component));
        return true;
    });
}

/// Packs the values of an attribute, which matches its accessor (Claims::checkAttributes).
std::vector<std::byte> packedElements(const draco::Mesh& mesh, const draco::PointAttribute& stored,
                                      const std::string& name, const tiny::Accessor& wanted) {
    const std::size_t elementBytes = bytesOf(wanted.componentType) * std::size_t(componentsOf(wanted));
    std::vector<std::byte> bytes(mesh.num_points() * elementBytes);
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = stored.mapped_index(draco::PointIndex(i));
        if (value.value() >= stored.size() || !convertPoint(stored, value, wanted, bytes.data() + i * elementBytes))
            throw InputError(
                fmt::format("holds in element {} of {} what its accessor's component type cannot", i, name));
    }
    return bytes;
}

std::vector<std::uint32_t> cornersOf(const draco::Mesh& mesh) {
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * std::size_t{mesh.num_faces()});
    for (std::uint32_t face = 0; face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(face))) {
            if (point.value() >= mesh.num_points())
                throw InputError(
                    fmt::format("{}: a triangle names vertex {} of {}", kBroken, point.value(), mesh.num_points()));
            corners.push_back(point.value());
        }
    return corners;
}

} // namespace

DracoStreams::DracoStreams(const Document& document, Buffers& buffers) : document_(document), buffers_(buffers) {
    for (const tiny::Mesh& mesh : document.model.meshes)
        for (const tiny::Primitive& primitive : mesh.primitives)
            if (const int view = viewOf(primitive); view != kNone) ++primitives_[view];
}

DracoGeometry DracoStreams::decode(const tiny::Primitive& primitive, const std::string& place,
                                   const std::string& meshName) {
    const std::string stream = place + "/extensions/KHR_draco_mesh_compression";
    const int view = viewOf(primitive);
    const std::span<const std::byte> bytes = buffers_.view(view);
    const std::uint64_t mark = document_.ledger.usedBytes();
    const Claims claims(document_, primitive, stream);
    DracoGeometry geometry;
    std::uint64_t keptBytes = 0;
    try {
        const auto known = shared_.find(view);
        std::shared_ptr<const draco::Mesh> decoded;
        if (known != shared_.end()) {
            decoded = known->second;
            claims.compareTriangles(decoded->num_faces());
            claims.compareAttributes(*decoded);
        } else {
            const auto made = std::make_shared<draco::Mesh>();
            decodeStream(bytes, claims, *made);
            decoded = made;
        }
        const draco::Mesh& mesh = *decoded;
        const auto keep = [&](std::uint64_t more) {
            claims.charge(more);
            keptBytes += more;
        };
        for (const auto& [name, id] : attributesOf(primitive)) {
            const auto named = primitive.attributes.find(name);
            if (named == primitive.attributes.end()) continue;
            const tiny::Accessor& wanted = document_.model.accessors[std::size_t(named->second)];
            keep(wanted.count * bytesOf(wanted.componentType) * std::size_t(componentsOf(wanted)));
            const draco::PointAttribute& stored = *mesh.GetAttributeByUniqueId(std::uint32_t(id));
            geometry.attributes[name] = packedElements(mesh, stored, name, wanted);
        }
        keep(3 * std::uint64_t{mesh.num_faces()} * sizeof(std::uint32_t));
        geometry.corners = cornersOf(mesh);
        if (known == shared_.end() && primitives_[view] > 1) {
            shared_[view] = decoded;
            const std::uint64_t sharedBytes = mesh.num_faces() * sizeof(draco::Mesh::Face) + pointBytes(mesh);
            heldBytes_ += sharedBytes;
            keptBytes += sharedBytes; // charged above
        }
    } catch (const MemoryRefused&) {
        throw; // names the place already
    } catch (const InputError& error) {
        document_.fail(stream, "the stream of mesh '{}' {}; compress the mesh anew, or leave it plain", meshName,
                       error.what());
    }
    document_.ledger.settle(mark, keptBytes);
    return geometry;
}

} // namespace tessera::scenes::gltf
