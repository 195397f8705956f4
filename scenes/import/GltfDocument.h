#pragma once
#include "scenes/import/Files.h"
#include "scenes/import/GltfModel.h"

namespace tessera::scenes::gltf {

/// A buffer, which is read on first use.
struct BufferSource {
    std::optional<std::size_t> byteLength; ///< unset: all of its data
    std::optional<std::string> uri;
};

/// A parsed and checked glTF file. Images are not loaded.
struct Document {
    std::string file;             ///< as the caller named it, for messages
    std::filesystem::path folder; ///< relative URIs start here
    LoadLedger& ledger;
    Repairs& repairs;
    std::optional<std::vector<std::byte>> binary = {}; ///< the binary chunk of a .glb
    tiny::Model model = {};                            ///< without `buffers` and `materials`
    std::vector<BufferSource> buffers = {};
    std::vector<StoredMaterial> materials = {};
    std::vector<double> wattsPerUnit = {}; ///< factor of each light's intensity (GltfSteps.h)

    /// Warns of a flaw at a place, as Repairs::note() does.
    template <typename... Values>
    void repair(std::string_view place, std::string_view repair, fmt::format_string<Values...> flaw,
                Values&&... values) const {
        repairs.note(file, place, repair, flaw, std::forward<Values>(values)...);
    }
    /// The file of the URI at a place. Throws InputError as fileOfUri() does.
    std::filesystem::path fileAt(std::string_view place, const std::string& uri) const;
    /// Throws InputError "file: place: what".
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;
    template <typename First, typename... Values>
    [[noreturn]] void fail(std::string_view place, fmt::format_string<First, Values...> what, First&& first,
                           Values&&... values) const {
        fail(place, fmt::format(what, std::forward<First>(first), std::forward<Values>(values)...));
    }
    /// Rethrows an error with file and place; a MemoryRefused keeps its type.
    [[noreturn]] void fail(std::string_view place, const InputError& error) const;
    /// The default scene; null if the document has none.
    const tiny::Scene* scene() const;
    /// Charges the ledger for memory to be allocated for `kind` `index`, such as accessors 3, or for a place.
    void charge(std::uint64_t bytes, std::string_view kind, int index) const;
    void charge(std::uint64_t bytes, std::string_view place) const;
};

/// Reads a .gltf or .glb, distinguished by the first bytes. Throws InputError if the file is missing, broken, of
/// another glTF version or requires an unsupported compression.
Document loadDocument(const std::filesystem::path& file, LoadLedger& ledger, Repairs& repairs);

/// Whether the importer reads an extension.
bool isSupported(std::string_view extension);

bool isDataUri(std::string_view uri);

/// The bytes of "data:[media type][;base64],..." (RFC 2397). Throws InputError with the reason.
std::vector<std::byte> decodeDataUri(std::string_view uri);

/// The file of a URI relative to `folder`: percent-decoded (RFC 3986) UTF-8, or the literal text if only that names a
/// file, in the spellings of fileNamed(). Throws InputError for a scheme other than `file`.
NamedFile fileOfUri(std::string_view uri, const std::filesystem::path& folder);

} // namespace tessera::scenes::gltf
