#pragma once
#include "scenes/import/Files.h"
#include "scenes/import/GltfModel.h"

namespace tessera::scenes::gltf {

/// A buffer, which is not loaded: what is never used is never read.
struct BufferSource {
    std::size_t byteLength = 0;
    std::optional<std::string> uri;
};

/// A glTF file that was read and checked. Images are not loaded.
struct Document {
    std::string file;             ///< as the caller named it, for messages
    std::filesystem::path folder; ///< relative URIs start here
    LoadLedger& ledger;
    Repairs& repairs;
    std::optional<std::vector<std::byte>> binary = {}; ///< the binary chunk of a .glb
    tiny::Model model = {};                            ///< without `buffers` and `materials`
    std::vector<BufferSource> buffers = {};
    std::vector<StoredMaterial> materials = {};
    std::vector<double> wattsPerUnit = {}; ///< of each light's intensity (GltfSteps.h)

    /// Warns of a flaw at a place, as Repairs::note() does.
    template <typename... Values>
    void repair(std::string_view place, std::string_view repair, fmt::format_string<Values...> flaw,
                Values&&... values) const {
        repairs.note(file, place, repair, flaw, std::forward<Values>(values)...);
    }
    /// The file that the URI at a place names. Throws InputError as fileOfUri() does.
    std::filesystem::path fileAt(std::string_view place, const std::string& uri) const;
    /// Throws InputError "file: place: what".
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;
    template <typename First, typename... Values>
    [[noreturn]] void fail(std::string_view place, fmt::format_string<First, Values...> what, First&& first,
                           Values&&... values) const {
        fail(place, fmt::format(what, std::forward<First>(first), std::forward<Values>(values)...));
    }
    /// The same with the text of an error, which stays a MemoryRefused if it is one.
    [[noreturn]] void fail(std::string_view place, const InputError& error) const;
    /// The default scene; null where the document has none.
    const tiny::Scene* scene() const;
    /// Charges the ledger for what `kind` `index`, such as accessors 3, or a place is about to take.
    void charge(std::uint64_t bytes, std::string_view kind, int index) const;
    void charge(std::uint64_t bytes, std::string_view place) const;
};

/// Reads a .gltf or .glb; which one it is follows from its first bytes, not from its name. Throws InputError when the
/// file is missing, broken, of another glTF version or requires a compression that is not supported.
Document loadDocument(const std::filesystem::path& file, LoadLedger& ledger, Repairs& repairs);

/// Whether the importer reads an extension.
bool isSupported(std::string_view extension);

bool isDataUri(std::string_view uri);

/// The bytes of "data:[media type][;base64],..." (RFC 2397). Throws InputError saying what is wrong with it.
std::vector<std::byte> decodeDataUri(std::string_view uri);

/// The file that a URI names: percent-decoded (RFC 3986) UTF-8, or as it stands where a file answers to that alone,
/// relative to `folder`, in the spellings that fileNamed() knows. Throws InputError for a scheme other than `file`.
NamedFile fileOfUri(std::string_view uri, const std::filesystem::path& folder);

} // namespace tessera::scenes::gltf
