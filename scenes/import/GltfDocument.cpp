#include "scenes/import/GltfDocument.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <system_error>

#include "base/Lowercase.h"
#include "scenes/import/Files.h"
#include "scenes/import/JsonReader.h"

namespace tessera::scenes::gltf {
namespace {

/// Decodes percent escapes; a '%' without two hexadecimal digits is literal.
std::string percentDecoded(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view digits = text.substr(i + 1, 2);
        unsigned char character = 0;
        const bool isEscape = text[i] == '%' && digits.size() == 2 &&
                              std::from_chars(digits.data(), digits.data() + 2, character, 16).ptr == digits.data() + 2;
        decoded.push_back(isEscape ? char(character) : text[i]);
        if (isEscape) i += 2;
    }
    return decoded;
}

/// Value of a base64 digit (RFC 4648, both alphabets), or -1.
int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

std::vector<std::byte> base64Decoded(std::string_view text) {
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int bitCount = 0;
    std::size_t digits = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (std::isspace(static_cast<unsigned char>(c))) continue;
        if (c == '=') {
            if (text.find_first_not_of("= \t\r\n", i) != std::string_view::npos)
                throw InputError("its base64 goes on after the padding '='");
            break;
        }
        const int digit = base64Digit(c);
        if (digit < 0) throw InputError(fmt::format("its base64 has an invalid character at position {}", i));
        ++digits;
        bits = (bits << 6 | std::uint32_t(digit)) & 0xffffffu;
        bitCount += 6;
        if (bitCount >= 8) {
            bitCount -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> bitCount & 0xffu));
        }
    }
    if (digits % 4 == 1) throw InputError("its base64 is cut short");
    return bytes;
}

/// RFC 3986: a letter, then letters, digits, '+', '-' or '.', then ':'. One letter alone is a Windows drive.
bool hasScheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon < 2 || !std::isalpha(static_cast<unsigned char>(uri[0]))) return false;
    for (const char c : uri.substr(0, colon))
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.') return false;
    return true;
}

// ---- Container -----------------------------------------------------------------------------------------------------

/// A glTF file split into its JSON text and, for .glb, its binary chunk.
struct Container {
    std::string json;
    std::optional<std::vector<std::byte>> binary;
};

constexpr std::uint32_t kMagic = 0x46546c67;       ///< "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;   ///< "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942; ///< "BIN\0"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

static_assert(std::endian::native == std::endian::little, "glTF numbers are little-endian");

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof(word));
    return word;
}

std::string textOf(std::span<const std::byte> bytes) {
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3); // a byte order mark is not JSON, but editors write it
    return text;
}

/// Source: glTF 2.0 section 4.4, "Binary glTF Layout".
Container readBinary(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
        throw InputError(fmt::format("{}: the glb is cut short: {} bytes do not hold its headers", name, bytes.size()));
    if (const std::uint32_t version = wordAt(bytes, 4); version != 2)
        throw InputError(fmt::format("{}: is glb version {}; only version 2 (glTF 2.0) is supported", name, version));
    const std::size_t length = wordAt(bytes, 8);
    if (length > bytes.size() || length < kHeaderBytes + kChunkHeaderBytes)
        throw InputError(fmt::format("{}: the glb is cut short or broken: its header says {} bytes, the file has {}",
                                     name, length, bytes.size()));
    Container container;
    std::size_t at = kHeaderBytes;
    for (int chunk = 0; at < length; ++chunk) {
        const std::size_t left = length - at, chunkBytes = left < kChunkHeaderBytes ? 0 : wordAt(bytes, at);
        if (left < kChunkHeaderBytes || chunkBytes > left - kChunkHeaderBytes)
            throw InputError(fmt::format("{}: the glb is broken: chunk {} says {} bytes, of {} with its header", name,
                                         chunk, chunkBytes, left));
        const std::uint32_t type = wordAt(bytes, at + 4);
        at += kChunkHeaderBytes;
        const std::span<const std::byte> content = bytes.subspan(at, chunkBytes);
        if (chunk == 0) {
            if (type != kJsonChunk)
                throw InputError(fmt::format("{}: the glb is broken: its first chunk is not JSON", name));
            container.json = textOf(content);
        } else if (type == kBinaryChunk && !container.binary) {
            container.binary.emplace(content.begin(), content.end());
        }
        at += chunkBytes;
    }
    return container;
}

Container readContainer(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::vector<std::byte> bytes = readFileBytes(file, ledger);
    const std::string name = file.string();
    ledger.charge(bytes.size(), [&] { return name; }); // a second copy, split into its parts
    if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty; export the model again", name));
    if (bytes.size() >= 4 && wordAt(bytes, 0) == kMagic) return readBinary(bytes, name);
    Container container{textOf(bytes), std::nullopt};
    const std::size_t first = container.json.find_first_not_of(" \t\r\n");
    constexpr std::string_view kBeginnings = "{/"; // '/' begins a comment, which is repaired
    if (first == std::string::npos || kBeginnings.find(container.json[first]) == kBeginnings.npos)
        throw InputError(fmt::format(
            "{}: is neither glTF JSON (begins with '{{') nor glb (begins with 'glTF'); {}", name,
            container.json.starts_with("version https://git-lfs") ? "it names a file of Git LFS: run git lfs pull"
            : first != std::string::npos && container.json[first] == '<' ? "it is a web page: download the file itself"
                                                                         : "export the model again"));
    return container;
}

// ---- JSON ----------------------------------------------------------------------------------------------------------

constexpr std::string_view kSupportedExtensions[] = {"EXT_lights_image_based",
                                                     "EXT_mesh_gpu_instancing",
                                                     "EXT_meshopt_compression",
                                                     "EXT_texture_webp",
                                                     "KHR_animation_pointer",
                                                     "KHR_draco_mesh_compression",
                                                     "KHR_lights_punctual",
                                                     "KHR_materials_anisotropy",
                                                     "KHR_materials_clearcoat",
                                                     "KHR_materials_dispersion",
                                                     "KHR_materials_emissive_strength",
                                                     "KHR_materials_ior",
                                                     "KHR_materials_iridescence",
                                                     "KHR_materials_pbrSpecularGlossiness",
                                                     "KHR_materials_sheen",
                                                     "KHR_materials_specular",
                                                     "KHR_materials_transmission",
                                                     "KHR_materials_unlit",
                                                     "KHR_materials_variants",
                                                     "KHR_materials_volume",
                                                     "KHR_mesh_quantization",
                                                     "KHR_node_visibility",
                                                     "KHR_texture_transform"};

/// Parses JSON. Repairs comments, surplus commas and words that are not JSON values.
nlohmann::json parseDocument(const std::string& text, const std::string& file, LoadLedger& ledger, Repairs& repairs) {
    requireJsonDepth(text, file);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        const MendedJson mended = mendedJson(text);
        requireJsonDepth(mended.text, file); // a quote in a comment may have hidden it
        ledger.charge(parsedJsonBytes(mended.text), [&] { return file + ": its JSON"; });
        nlohmann::json parsed = nlohmann::json::parse(mended.text, nullptr, false);
        if (mended.line != 0 && !parsed.is_discarded()) {
            repairs.note(file, mended.line,
                         "words of no JSON value are null, characters of none U+FFFD, and the rest is left out", "{}",
                         mended.flaw);
            return parsed;
        }
        std::string what = error.what(); // "[json.exception.parse_error.101] parse error at line ..."
        if (const std::size_t end = what.find("] "); what.starts_with('[') && end != std::string::npos)
            what.erase(0, end + 2);
        std::ranges::replace(what, '\n', ' ');
        throw InputError(fmt::format("{}: is not JSON: {}", file, what));
    }
}

/// Refuses unsupported versions before the structure is checked, which differs between versions.
void checkVersion(const nlohmann::json& json, const std::string& file) {
    const auto asset = json.is_object() ? json.find("asset") : json.end();
    if (!json.is_object() || asset == json.end() || !asset->is_object())
        throw InputError(
            fmt::format("{}: /asset: is missing; every glTF 2.0 file has one, glTF 1.0 is not supported", file));
    for (const char* key : {"minVersion", "version"}) {
        const auto version = asset->find(key);
        if (version == asset->end()) continue;
        // glTF 1.0 files write a number here.
        const std::string text = version->is_string()   ? version->get<std::string>()
                                 : version->is_number() ? version->dump()
                                                        : version->type_name();
        const bool good = std::string_view(key) == "version" ? text == "2" || text.starts_with("2.") : text == "2.0";
        if (!good)
            throw InputError(fmt::format(
                "{}: /asset/{}: is '{}', but only glTF 2.0 is supported; export the model as 2.0", file, key, text));
    }
}

void checkRequiredExtensions(const Document& document) {
    for (const std::string& extension : document.model.extensionsRequired) {
        if (isSupported(extension)) continue;
        const std::string what =
            fmt::format("the model requires {}, which is not supported; export it without", extension);
        // Compressed data cannot be read. Other extensions can be ignored; most only change shading.
        if (extension.find("compression") != extension.npos) document.fail("/extensionsRequired", what);
        document.repair("/extensionsRequired", "it is drawn without", "{}", what);
    }
}

} // namespace

bool isSupported(std::string_view extension) {
    return std::ranges::find(kSupportedExtensions, extension) != std::end(kSupportedExtensions);
}

bool isDataUri(std::string_view uri) {
    return startsWithWord(uri, "data:");
}

std::vector<std::byte> decodeDataUri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos)
        throw InputError("its data URI has no comma before the data");
    std::string header(uri.substr(0, comma));
    std::erase(header, ' ');
    const std::string data = percentDecoded(uri.substr(comma + 1));
    constexpr std::string_view kBase64 = ";base64";
    if (header.size() >= kBase64.size() &&
        startsWithWord(std::string_view(header).substr(header.size() - kBase64.size()), kBase64))
        return base64Decoded(data);
    const auto* first = reinterpret_cast<const std::byte*>(data.data());
    return {first, first + data.size()};
}

NamedFile fileOfUri(std::string_view uri, const std::filesystem::path& folder) {
    constexpr std::string_view kFile = "file:";
    if (startsWithWord(uri, kFile)) uri.remove_prefix(kFile.size());
    if (uri.empty()) throw InputError("its uri is empty");
    if ((uri.starts_with("//") && !uri.starts_with("///")) || hasScheme(uri))
        throw InputError(
            fmt::format("its uri '{}' is not a relative path; put the file beside the model", uri.substr(0, 80)));
    const std::string decoded = percentDecoded(uri);
    if (decoded.find('\0') != std::string::npos) throw InputError("its uri holds a zero character");
    const NamedFile file = fileNamed(folder, decoded);
    if (file.isFound && file.isAsNamed) return file;
    const NamedFile literal = fileNamed(folder, std::string(uri));
    return literal.isFound && (literal.isAsNamed || !file.isFound) ? literal : file;
}

void Document::fail(std::string_view place, std::string_view what) const {
    throw InputError(fmt::format("{}: {}: {}", file, place, what));
}

void Document::fail(std::string_view place, const InputError& error) const {
    if (dynamic_cast<const MemoryRefused*>(&error) != nullptr)
        throw MemoryRefused(fmt::format("{}: {}: {}", file, place, error.what()));
    fail(place, std::string_view(error.what()));
}

std::filesystem::path Document::fileAt(std::string_view place, const std::string& uri) const {
    NamedFile named;
    try {
        named = fileOfUri(uri, folder);
    } catch (const InputError& error) {
        fail(place, error);
    }
    if (!named.isAsNamed)
        repair(place, "that one is read", "names '{}', which is there as '{}'", uri,
               named.path.lexically_relative(folder).string());
    return named.path;
}

void Document::charge(std::uint64_t bytes, std::string_view kind, int index) const {
    ledger.charge(bytes, [&] { return fmt::format("{}: /{}/{}", file, kind, index); });
}

void Document::charge(std::uint64_t bytes, std::string_view place) const {
    ledger.charge(bytes, [&] { return fmt::format("{}: {}", file, place); });
}

const tiny::Scene* Document::scene() const {
    return model.scenes.empty() ? nullptr : &model.scenes[std::size_t(std::max(model.defaultScene, 0))];
}

Document loadDocument(const std::filesystem::path& file, LoadLedger& ledger, Repairs& repairs) {
    Document document{file.string(), file.parent_path(), ledger, repairs};
    Container container = readContainer(file, ledger);
    document.binary = std::move(container.binary);
    ledger.charge(parsedJsonBytes(container.json), [&] { return document.file + ": its JSON"; });
    nlohmann::json json = parseDocument(container.json, document.file, ledger, repairs);
    container.json = {};
    checkVersion(json, document.file);
    nlohmann::json checked = checkedProperties(json, document.file, ledger, repairs);
    json = nullptr;
    if (const auto buffers = checked.find("buffers"); buffers != checked.end())
        for (nlohmann::json& buffer : *buffers) {
            BufferSource& source = document.buffers.emplace_back();
            if (const auto length = buffer.find("byteLength"); length != buffer.end()) source.byteLength = *length;
            if (const auto uri = buffer.find("uri"); uri != buffer.end())
                source.uri = std::move(uri->get_ref<std::string&>());
        }
    document.model = tinyModel(std::move(checked), document.file, ledger);
    for (const tiny::Material& material : document.model.materials) document.materials.emplace_back(material);
    document.model.materials = {};
    document.wattsPerUnit.assign(document.model.lights.size(), 1.0);
    checkRequiredExtensions(document);
    return document;
}

} // namespace tessera::scenes::gltf
