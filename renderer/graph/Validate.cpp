#include "renderer/graph/Validate.h"

#include <algorithm>

#include <fmt/format.h>

#include "renderer/graph/Access.h"

namespace tessera::graph {
namespace {

class Validator {
public:
    Validator(const Graph& graph, const Flow& flow) : graph_(graph), flow_(flow) {}

    std::vector<std::string> run() {
        for (std::uint32_t resource = 0; resource < graph_.resources().size(); ++resource) {
            checkShape(resource);
            checkKept(resource);
        }
        for (const Graph::Pass& pass : graph_.passes()) {
            const std::string subject = fmt::format("pass '{}'", pass.name);
            for (const Graph::Use& use : pass.uses) {
                const std::string verb = subject + (use.isWrite ? " writes" : " reads");
                if (!checkHandle(verb, use.resource, use.isTexture)) continue;
                checkAccess(verb, use);
                checkPart(verb, use);
                checkVersion(verb, use);
            }
            checkExpectations(subject, pass);
            checkAttachments(subject, pass);
            checkStores(subject, pass);
        }
        for (const Graph::Use& output : graph_.outputs()) checkOutput(output);
        return std::move(faults_);
    }

private:
    const Graph::Resource& resource(std::uint32_t index) const { return graph_.resources()[index]; }
    const std::string& nameOf(const Graph::Use& use) const { return resource(use.resource).name; }

    /// Reports a fault once, even if several places show it.
    void report(std::string fault) {
        if (std::find(faults_.begin(), faults_.end(), fault) == faults_.end()) faults_.push_back(std::move(fault));
    }

    void checkShape(std::uint32_t index) {
        const Graph::Resource& made = resource(index);
        const auto creator = flow_.writer(index, 1);
        const std::string origin = made.imported || !creator
                                       ? "imported"
                                       : fmt::format("created by pass '{}'", graph_.passes()[*creator].name);
        const auto* texture = std::get_if<TextureDesc>(&made.desc);
        if (texture && (texture->width < 1 || texture->height < 1 || texture->samples < 1))
            report(fmt::format("texture '{}', {}, is empty ({}): width, height and samples must be at least 1",
                               made.name, origin, describeSize(made.desc)));
        else if (const std::string fault = texture ? faultOfShape(*texture) : ""; !fault.empty())
            report(
                fmt::format("texture '{}', {}, cannot be ({}): {}", made.name, origin, describeSize(made.desc), fault));
        const auto* buffer = std::get_if<BufferDesc>(&made.desc);
        if (buffer && !made.imported && buffer->bytes == 0 && !buffer->grows)
            report(fmt::format("buffer '{}', {}, is empty: it must have at least 1 byte, or grow", made.name, origin));
    }

    /// Imported buffers cannot grow, since the frame does not own them. Persistent resources need unique names.
    void checkKept(std::uint32_t index) {
        const Graph::Resource& kept = resource(index);
        const auto* buffer = std::get_if<BufferDesc>(&kept.desc);
        if (buffer && buffer->grows && kept.imported)
            report(fmt::format("buffer '{}', imported, cannot grow: only a buffer that the frame creates does",
                               kept.name));
        for (std::uint32_t other = 0; kept.revision && other < index; ++other)
            if (resource(other).revision && resource(other).name == kept.name)
                report(fmt::format("two resources that live across frames are named '{}'", kept.name));
    }

    static std::string faultOfShape(const TextureDesc& desc) {
        const int most = mipLevelsFor(desc.width, desc.height);
        if (desc.levels < 1 || desc.levels > most) return fmt::format("it can have 1 to {} levels", most);
        if (desc.shape == Shape::Flat && desc.layers != 1) return "only an array has layers";
        if (desc.shape == Shape::Array && desc.layers < 1) return "an array has 1 layer or more";
        if (desc.shape == Shape::Cube && (desc.layers != 6 || desc.width != desc.height))
            return "a cube has 6 layers, as wide as high";
        if (desc.samples > 1 && (desc.levels > 1 || desc.shape != Shape::Flat))
            return "with several samples it has one level and one layer";
        return {};
    }

    void checkPart(const std::string& verb, const Graph::Use& use) {
        const auto* desc = std::get_if<TextureDesc>(&resource(use.resource).desc);
        if (desc == nullptr || !isOfPart(use.access)) return;
        const auto [level, layer] = use.part;
        if (level < 0 || level >= desc->levels || layer < 0 || layer >= desc->layers)
            report(fmt::format("{} level {}, layer {} of '{}', which has {} and {}", verb, level, layer, nameOf(use),
                               desc->levels, desc->layers));
    }

    bool checkHandle(const std::string& verb, std::uint32_t index, bool isTexture) {
        const char* kind = isTexture ? "texture" : "buffer";
        if (index == TextureHandle::kInvalid)
            report(fmt::format("{} an invalid {} handle: it was default-constructed and never filled in", verb, kind));
        else if (index >= graph_.resources().size())
            report(fmt::format("{} a {} handle of another graph: it names no resource of this one", verb, kind));
        else if (std::holds_alternative<TextureDesc>(resource(index).desc) != isTexture)
            report(fmt::format("{} '{}' by a {} handle, but it is a {}", verb, resource(index).name, kind,
                               isTexture ? "buffer" : "texture"));
        else
            return true;
        return false;
    }

    void checkAccess(const std::string& verb, const Graph::Use& use) {
        const AccessInfo& info = accessInfo(use.access);
        if (info.isWrite != use.isWrite) {
            report(fmt::format("{} '{}' as {}, which is an access for {}", verb, nameOf(use), info.name,
                               info.isWrite ? "writing; use write()" : "reading; use read()"));
            return;
        }
        const std::string reason = unfitReason(resource(use.resource).desc, use.access);
        if (!reason.empty()) report(fmt::format("{} '{}' as {}, but {}", verb, nameOf(use), info.name, reason));
    }

    bool exists(const Graph::Use& use) const {
        if (use.handed == 0) return resource(use.resource).hasContents;
        return use.handed <= resource(use.resource).newestVersion;
    }

    void checkVersion(const std::string& verb, const Graph::Use& use) {
        if (use.isWrite && use.stale && use.handed < use.version)
            report(fmt::format("{} version {} of '{}' by a stale handle: pass '{}' has already written it (two writers "
                               "of one version); write the handle that pass '{}' returned",
                               verb, use.handed, nameOf(use), writerName(use.resource, use.handed + 1),
                               writerName(use.resource, use.version - 1)));
        else if (use.isWrite && use.stale)
            report(fmt::format("{} version {} of '{}' before any pass has produced it; declare its producer first",
                               verb, use.handed, nameOf(use)));
        else if (!use.isWrite && !exists(use))
            report(fmt::format("{} version {} of '{}', which no pass produces", verb, use.handed, nameOf(use)));
    }

    std::string writerName(std::uint32_t index, std::uint32_t version) const {
        return graph_.passes()[flow_.writer(index, version).value()].name;
    }

    void checkExpectations(const std::string& subject, const Graph::Pass& pass) {
        for (const Graph::Expectation& expectation : pass.expectations) {
            if (!checkHandle(subject + " expects something of", expectation.resource, true)) continue;
            const std::string expects =
                fmt::format("{} expects '{}' to have", subject, resource(expectation.resource).name);
            const auto& is = std::get<TextureDesc>(resource(expectation.resource).desc);
            const TextureDesc& wanted = expectation.desc;
            if (is.format != wanted.format)
                report(fmt::format("{} format {}, but it has {}", expects, formatInfo(wanted.format).name,
                                   formatInfo(is.format).name));
            if ((wanted.width != 0 && is.width != wanted.width) || (wanted.height != 0 && is.height != wanted.height))
                report(fmt::format("{} size {} x {}, but it has {} x {}", expects, anyOr(wanted.width),
                                   anyOr(wanted.height), is.width, is.height));
            if (wanted.samples != 0 && is.samples != wanted.samples)
                report(fmt::format("{} samples {}, but it has {}", expects, wanted.samples, is.samples));
            if (is.shape != wanted.shape || is.layers != wanted.layers || is.levels != wanted.levels)
                report(fmt::format("{} the shape {}, but it has {}", expects, shapeOf(wanted), shapeOf(is)));
        }
    }

    static std::string shapeOf(const TextureDesc& desc) {
        const char* const name = desc.shape == Shape::Flat ? "flat" : desc.shape == Shape::Array ? "array" : "cube";
        return fmt::format("{} of {} layers and {} levels", name, desc.layers, desc.levels);
    }

    static std::string anyOr(int size) { return size == 0 ? "any" : std::to_string(size); }

    /// Checks that attachments form one framebuffer: equal size and samples, one depth texture, no duplicates, none
    /// sampled, loaded or stored (a feedback loop, undefined by the OpenGL 4.5 core specification, section 9.3.1).
    void checkAttachments(const std::string& subject, const Graph::Pass& pass) {
        const Graph::Use* first = nullptr;
        const Graph::Use* depth = nullptr;
        for (const Graph::Use& use : pass.uses) {
            if (!isAttachment(use.access) || !isUsableTexture(use)) continue;
            const TextureDesc desc = attachedDesc(use);
            if (!first) first = &use;
            const TextureDesc reference = attachedDesc(*first);
            if (desc.width != reference.width || desc.height != reference.height || desc.samples != reference.samples)
                report(fmt::format("{} attaches '{}' ({}) and '{}' ({}), which must be equal in size and samples",
                                   subject, nameOf(*first), describeSize(reference), nameOf(use), describeSize(desc)));
            if (use.access != Access::ColorAttachment) {
                if (depth && (depth->resource != use.resource || depth->part != use.part))
                    report(fmt::format("{} attaches two depth textures or parts, of '{}' and '{}'", subject,
                                       nameOf(*depth), nameOf(use)));
                depth = &use;
            }
            if (use.isWrite) checkAlone(subject, pass, use);
        }
    }

    TextureDesc attachedDesc(const Graph::Use& use) const {
        TextureDesc desc = mipDesc(std::get<TextureDesc>(resource(use.resource).desc), use.part.level);
        desc.layers = 1;
        desc.shape = Shape::Flat;
        return desc;
    }

    void checkAlone(const std::string& subject, const Graph::Pass& pass, const Graph::Use& attached) {
        for (const Graph::Use& other : pass.uses) {
            if (&other == &attached || other.resource != attached.resource) continue;
            if (other.isWrite && isAttachment(other.access) && other.part == attached.part)
                report(fmt::format("{} attaches '{}' twice", subject, nameOf(attached)));
            if (other.access == Access::Sampled)
                report(fmt::format("{} samples '{}' while it draws into it", subject, nameOf(attached)));
            const bool isImage = other.access == Access::ImageRead || other.access == Access::ImageWrite;
            if (isImage && other.part == attached.part && isFit(other))
                report(fmt::format("{} uses '{}' as {} while it draws into that part of it", subject, nameOf(attached),
                                   accessInfo(other.access).name));
        }
    }

    /// Checks that a pass reads its shader stores only by accesses of the same kind, which a shader can order itself.
    /// Others need a GL barrier (OpenGL 4.5 core specification, section 7.13.2), and barriers are issued only between
    /// passes.
    void checkStores(const std::string& subject, const Graph::Pass& pass) {
        for (const Graph::Use& store : pass.uses) {
            const AccessInfo& stored = accessInfo(store.access);
            if (!stored.incoherent) continue;
            for (const Graph::Use& other : pass.uses) {
                const AccessInfo& read = accessInfo(other.access);
                if (other.resource != store.resource || !read.readsInShader || read.barrier == stored.barrier) continue;
                if (!isFit(store) || !isFit(other)) continue;
                report(fmt::format("{} reads '{}' as {} and writes it as {}, and nothing orders the two within a pass; "
                                   "read it as {} or in a pass of its own",
                                   subject, nameOf(store), read.name, stored.name,
                                   store.access == Access::ImageWrite ? "ImageRead" : "StorageRead"));
            }
        }
    }

    bool isUsableTexture(const Graph::Use& use) const {
        return use.resource < graph_.resources().size() &&
               std::holds_alternative<TextureDesc>(resource(use.resource).desc);
    }

    /// Whether a resource of the graph allows the access; if not, another check reports it.
    bool isFit(const Graph::Use& use) const {
        return use.resource < graph_.resources().size() && unfitReason(resource(use.resource).desc, use.access).empty();
    }

    void checkOutput(const Graph::Use& output) {
        if (!checkHandle("the frame outputs", output.resource, output.isTexture)) return;
        if (!exists(output))
            report(fmt::format("the frame outputs version {} of '{}', which no pass produces", output.version,
                               nameOf(output)));
        else if (output.version < resource(output.resource).newestVersion)
            report(fmt::format("the frame outputs version {} of '{}' by a stale handle: pass '{}' writes over it",
                               output.version, nameOf(output), writerName(output.resource, output.version + 1)));
    }

    const Graph& graph_;
    const Flow& flow_;
    std::vector<std::string> faults_;
};

} // namespace

std::vector<std::string> findFaults(const Graph& graph, const Flow& flow) {
    return Validator(graph, flow).run();
}

} // namespace tessera::graph
