#include "viewer/show/Screen.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Error.h"
#include "engine/Rendering.h"
#include "renderer/frame/DebugViews.h"
#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Timer.h"
#include "renderer/graph/Execute.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/Inspection.h"

namespace tessera::viewer {
namespace {

/// Input must be answered within 100 ms. Input that arrives just after a frame has begun waits for two frames, each
/// with panels and presentation, or for one piece of an aborted frame. This time is left for an image.
constexpr double kMovingMs = 36.0;
/// Initial scale, while no times are known.
constexpr double kSoftwareGuess = 0.25;
/// Height of the image drawn for a slice of diffusion, which is not displayed.
constexpr int kSliceRows = 48;

constexpr glm::vec4 kBehindPicture{0.05f, 0.05f, 0.055f, 1.0f};

/// Whether a pixel of b costs about as much as one of a.
bool isOfKind(const Look& a, const Look& b) {
    Look like = a;
    for (const engine::Setting& setting : engine::settingTable())
        if (setting.sameCost) setting.value.copy(like, b);
    return like == b;
}

std::span<const Look> looksOf(const Screen::Wanted& wanted) {
    return std::span(wanted.looks).first(std::size_t(wanted.sides));
}

/// While one exists, frames diffuse no more irradiance than the limit.
class LimitedDiffusion {
public:
    LimitedDiffusion(engine::Renderer& renderer, std::optional<engine::DiffusionLimit> limit) : renderer_(renderer) {
        renderer_.limitDiffusion(limit);
    }
    ~LimitedDiffusion() { renderer_.limitDiffusion({}); }
    LimitedDiffusion(const LimitedDiffusion&) = delete;
    LimitedDiffusion& operator=(const LimitedDiffusion&) = delete;

private:
    engine::Renderer& renderer_;
};

glm::ivec2 scaled(glm::ivec2 size, double scale) {
    return glm::max(glm::ivec2(glm::round(glm::dvec2(size) * scale)), glm::ivec2(1));
}

/// At least as wide relative to its height as the full image, so that everything in its view is covered.
glm::ivec2 sliceSize(glm::ivec2 whole) {
    const int rows = std::min(kSliceRows, whole.y);
    return {int(std::ceil(double(whole.x) * rows / whole.y)), rows};
}

} // namespace

Screen::Screen(gpu::Context& context) : context_(context), resolution_(kMovingMs) {}

void Screen::open(const OpenScene& scene) {
    renderer_ = std::make_unique<engine::Renderer>(context_, scene.scene());
    renderer_->environmentChanged(scene.filteredEnvironment());
    scene_ = &scene;
    // Required for pass times of software rasterisers (GraphBackend.h).
    renderer_->backend().setProfiling(context_.capabilities().isSoftware);
    geometryRevision_ = scene.geometryRevision();
    materialRevision_ = scene.materialRevision();
    environmentRevision_ = scene.environmentRevision();
    forget();
    programs_.reset();
    known_.clear(); // the new renderer has yet to compile them
    kind_.reset();
    pace_ = {};
    latestMs_ = 0.0;
    resolution_.restart(context_.capabilities().isSoftware ? kSoftwareGuess : 1.0);
}

bool Screen::isNewKind(const Wanted& wanted) const {
    return !kind_ || !isOfKind((*kind_)[0], wanted.looks[0]) ||
           (wanted.sides == 2 && !isOfKind((*kind_)[1], wanted.looks[1])) || lacksPrograms(wanted);
}

bool Screen::lacksPrograms(const Wanted& wanted) const {
    return !std::ranges::includes(known_, programsOf(wanted));
}

const std::set<std::string>& Screen::programsOf(const Wanted& wanted) const {
    if (programs_ && programs_->wanted == wanted) return programs_->keys;
    Programs& programs = programs_.emplace(Programs{wanted, {}});
    try {
        for (const Look& look : looksOf(wanted))
            for (const shader::ProgramDesc& program : renderer_->programsOf(look.technique, look.settings))
                programs.keys.insert(program.key());
    } catch (const InputError&) {
        programs.keys.clear(); // drawing fails likewise, and reports why
    }
    return programs.keys;
}

bool Screen::diffusesAnew(const Wanted& wanted) const {
    return scene_ != nullptr && diffusedLight_.isAnew(scene_->scene(), looksOf(wanted), wanted.sceneEdits);
}

void Screen::recordDiffusedLight(const Wanted& drawn) {
    diffusedLight_.drew(scene_->scene(), looksOf(drawn), drawn.sceneEdits, renderer_->backend().mostIdleFrames());
}

void Screen::forgetDiffusedLight() {
    diffusedLight_.forget();
    diffusedFor_.reset();
    isAllDiffused_ = isAllTooMuch_ = false;
}

bool Screen::lacksLight(const Wanted& wanted, Reach reach) const {
    if (scene_ == nullptr || failed_ == wanted || !sharedDiffusion(scene_->scene(), looksOf(wanted))) return false;
    if (diffusesAnew(wanted)) return true;
    return !isAllDiffused_ && (reach == Reach::All ? !isAllTooMuch_ : diffusedFor_ != wanted);
}

engine::DiffusionProgress Screen::diffuseSlice(const Wanted& wanted, Reach reach) {
    const Look look = sharedDiffusion(scene_->scene(), looksOf(wanted)).value();
    if (diffusesAnew(wanted)) forgetDiffusedLight();
    Look small = look;
    small.settings.wholePixels = look.settings.sizePixels;
    small.settings.sizePixels = sliceSize(look.settings.sizePixels);
    const std::size_t programs = renderer_->programs().size();
    const LimitedDiffusion limited(*renderer_, engine::DiffusionLimit{pace_.tiles(), reach == Reach::All});
    const gpu::CpuTimer clock;
    try {
        renderer_->draw(small.technique, small.settings);
        gpu::finish();
    } catch (...) {
        failed_ = wanted;
        throw;
    }
    if (renderer_->programs().size() == programs) pace_.took(clock.elapsedMs());
    // Images that do not stay can use what is there.
    diffusedLight_.drew(scene_->scene(), {&look, 1}, wanted.sceneEdits, renderer_->backend().mostIdleFrames());
    const engine::DiffusionProgress progress = renderer_->diffusionProgress();
    if (progress.isDone()) diffusedFor_ = wanted;
    if (progress.isDone() && reach == Reach::All) (progress.isOfAll ? isAllDiffused_ : isAllTooMuch_) = true;
    return progress;
}

void Screen::takeEdits() {
    if (scene_ == nullptr) return;
    if (scene_->geometryRevision() != geometryRevision_) renderer_->geometryChanged();
    if (scene_->materialRevision() != materialRevision_) renderer_->materialsChanged();
    if (scene_->environmentRevision() != environmentRevision_)
        renderer_->environmentChanged(scene_->filteredEnvironment());
    geometryRevision_ = scene_->geometryRevision();
    materialRevision_ = scene_->materialRevision();
    environmentRevision_ = scene_->environmentRevision();
}

const Screen::Made* Screen::madeFor(const Wanted& wanted, int side) const {
    const std::optional<Made>& made = made_[std::size_t(side)];
    const bool isWanted = made && made->look == wanted.looks[std::size_t(side)] &&
                          made->sceneRevision == wanted.sceneRevision && made->sceneEdits == wanted.sceneEdits &&
                          (!wanted.keepsRadiance || picture(side).radiance() != nullptr);
    return isWanted ? &*made : nullptr;
}

double Screen::scaleOf(const Wanted& wanted) const {
    double scale = 1.0;
    for (int side = 0; side < wanted.sides && failed_ != wanted; ++side) {
        const Made* const made = madeFor(wanted, side);
        // A lower scale, so that a complete image follows.
        scale = std::min(scale, made == nullptr ? 0.0 : made->lacksLight ? made->scale * kScales[1] : made->scale);
    }
    return scale;
}

double Screen::shownScale(const Wanted& wanted) const {
    double scale = 1.0;
    for (int side = 0; side < wanted.sides; ++side) {
        const Made* const made = madeFor(wanted, side);
        scale = std::min(scale, made == nullptr ? 0.0 : made->scale);
    }
    return scale;
}

bool Screen::hasLights(const Wanted& wanted) const {
    for (int side = 0; side < wanted.sides; ++side)
        if (!hasLights(side)) return false;
    return true;
}

bool Screen::canDiffer() const {
    const Target* const a = pictures_[0].radiance();
    const Target* const b = pictures_[1].radiance();
    return a != nullptr && b != nullptr && a->sizePixels() == b->sizePixels() && isOfOneScene();
}

Screen::Drawn Screen::draw(const Wanted& wanted, double scale, Stay stay, bool keepsLights,
                           const std::function<bool()>& givesUp) {
    const bool isAnew = diffusesAnew(wanted), isCoarse = isAnew && stay != Stay::Stays;
    // GPUs diffuse irradiance of newly visible surfaces within the frame.
    const bool isLimited = !isAnew && stay != Stay::Stays && context_.capabilities().isSoftware;
    const bool mayLack = isCoarse || (isLimited && lacksLight(wanted, Reach::Seen));
    if (mayLack && stay == Stay::Passes) scale = std::min(scale, kScales[1]);
    Drawn result;
    result.scale = scale;
    result.sizePixels = scaled(wanted.looks[0].settings.sizePixels, scale);
    for (int side = 0; side < wanted.sides; ++side) {
        const Made* const made = madeFor(wanted, side);
        result.isOfSide[std::size_t(side)] = made == nullptr || made->scale < scale || (made->lacksLight && !mayLack) ||
                                             (keepsLights && !hasLights(side));
    }
    isOfSide_ = result.isOfSide;
    const bool isNew = isNewKind(wanted), isSlowKind = isSlow(wanted);
    failed_.reset();
    if (isAnew)
        forgetDiffusedLight();
    else
        recordDiffusedLight(wanted);
    const std::size_t programs = renderer_->programs().size();
    bool isLacking = false;
    const LimitedDiffusion limited(*renderer_, isLimited ? std::optional(engine::DiffusionLimit{}) : std::nullopt);
    try {
        std::optional<gpu::BandedDrawing> banded;
        if (givesUp) banded.emplace(givesUp, gpu::BandPace{isSlowKind});
        for (int side = 0; side < wanted.sides; ++side) {
            if (!result.isOfSide[std::size_t(side)]) continue;
            drawingSide_ = side;
            const gpu::CpuTimer clock;
            Look look = wanted.looks[std::size_t(side)];
            look.settings.wholePixels = look.settings.sizePixels;
            look.settings.sizePixels = result.sizePixels;
            int& atlasTexels = look.settings.diffusion.sideTexels;
            if (isCoarse) atlasTexels = std::min(atlasTexels, kPassingAtlasTexels);
            renderer_->draw(look.technique, look.settings);
            gpu::finish();
            result.sideMs[std::size_t(side)] = clock.elapsedMs();
            result.ms += clock.elapsedMs();
            result.passes[std::size_t(side)] = renderer_->backend().passTimings();
            result.shadows[std::size_t(side)] = renderer_->shadows();
            result.missingTextures = renderer_->missingTextures();
            if (!isCoarse) result.invisibleDiffusion = renderer_->invisibleDiffusion();
            isLacking = isLacking || !renderer_->diffusionProgress().isDone();
            banded.reset(); // copying must not be aborted half way
            DrawnPicture& taken = side == 0 && result.isOfSide[1] ? waiting_ : pictures_[std::size_t(side)];
            if (&taken == &pictures_[std::size_t(side)]) made_[std::size_t(side)].reset(); // in case copying fails
            // An image that stays may be compared or inspected later.
            taken.take(*renderer_, look, {wanted.keepsRadiance || stay == Stay::Stays, keepsLights});
            if (givesUp) banded.emplace(givesUp, gpu::BandPace{isSlowKind});
        }
    } catch (const graph::Interrupted&) {
        result.gaveUp = true; // the images are unchanged
        return result;
    } catch (...) {
        failed_ = wanted;
        throw;
    }
    if (result.isOfSide[0] && result.isOfSide[1]) std::swap(waiting_, pictures_[0]);
    result.lacksLight = mayLack || isLacking;
    for (int side = 0; side < wanted.sides; ++side)
        if (result.isOfSide[std::size_t(side)]) {
            shownScene_[std::size_t(side)] = wanted.sceneRevision;
            made_[std::size_t(side)] = {wanted.looks[std::size_t(side)], wanted.sceneRevision, wanted.sceneEdits, scale,
                                        result.lacksLight};
        }
    if (isAnew && !isCoarse) recordDiffusedLight(wanted);
    kind_ = wanted.looks;
    const std::set<std::string>& programsDrawn = programsOf(wanted);
    known_.insert(programsDrawn.begin(), programsDrawn.end());
    if (isLacking) { // whatever removed it
        diffusedFor_.reset();
        isAllDiffused_ = false;
    }
    differenceIsStale_ = true;
    const bool compiled = renderer_->programs().size() != programs;
    result.isUnlike = isNew || compiled || (isAnew && !isCoarse);
    if (result.isUnlike) return result;
    // Only times of all sides together count.
    if (std::count(result.isOfSide.begin(), result.isOfSide.begin() + wanted.sides, true) != wanted.sides)
        return result;
    resolution_.drew(scale, result.ms);
    if ((scale < 1.0 && stay != Stay::Refines) || result.ms < kSlowMs) latestMs_ = result.ms;
    return result;
}

bool Screen::lacksSmoothing(const Wanted& wanted) const {
    const bool canBe = shows(wanted) && scaleOf(wanted) == 1.0 && wanted.sides == 1 &&
                       wanted.looks[0].settings.view == frame::DebugView::Final;
    return canBe && (smoothed_ != wanted || !(smoothing_.isDone() || isSmoothingAtFault_));
}

bool Screen::smooth(const Wanted& wanted, const std::function<bool()>& givesUp) {
    if (smoothed_ != wanted) {
        smoothing_.restart();
        smoothed_ = wanted;
        isSmoothingAtFault_ = false;
    }
    Look look = wanted.looks[0];
    look.settings.wholePixels = look.settings.sizePixels;
    look.settings.offsetPixels = Smoothing::offsetPixels(smoothing_.count());
    try {
        {
            const gpu::BandedDrawing banded(givesUp, gpu::BandPace{latestMs_ > kSlowMs});
            renderer_->draw(look.technique, look.settings);
            gpu::finish();
        }
        smoothing_.add(renderer_->programs(), renderer_->radianceTexture());
        constexpr int kFirstShown = 8; // fewer are still noisy
        if (smoothing_.count() % kFirstShown == 0) smoothing_.showMean(renderer_->programs(), look.settings);
        return true;
    } catch (const graph::Interrupted&) {
        return false;
    } catch (...) {
        isSmoothingAtFault_ = true; // a retry would fail again
        throw;
    }
}

void Screen::prepareDifference(float factor) {
    if (!canDiffer() || (!differenceIsStale_ && factor == differenceFactor_)) return;
    differenceFactor_ = factor;
    differenceIsStale_ = false; // even if it fails: a retry would fail again
    difference_.update(renderer_->programs(), *pictures_[0].radiance(), *pictures_[1].radiance(), factor);
}

void Screen::colorCounts(const std::function<float(int side, frame::DebugView view)>& scaleLog2) {
    for (int side = 0; side < 2; ++side) {
        DrawnPicture& shown = pictures_[std::size_t(side)];
        if (!shown.isThere() || shown.radiance() == nullptr || !showsCounts(shown.look())) continue;
        const float wanted = scaleLog2(side, shown.look().settings.view);
        if (shown.countScaleLog2() == wanted) continue;
        shown.setCountScale(wanted); // even if it fails: a retry would fail again
        countColors_.update(renderer_->programs(), *shown.radiance(), shown.display(), wanted);
    }
}

void Screen::show(glm::ivec2 windowPixels, const gpu::Rectangle& area, Compare compare, float divider,
                  const Magnification& magnification) {
    gpu::bindWindowFramebuffer(windowPixels.x, windowPixels.y);
    gpu::clearColor(0, kBehindPicture);
    if (!pictures_[0].isThere() || area.width < 1 || area.height < 1) return;
    // The rectangle of the whole image, from the lower left; the scissor keeps the part in the area.
    const int times = magnification.times;
    const glm::ivec2 corner = glm::round(magnification.corner * float(times) * glm::vec2(area.width, area.height));
    const gpu::Rectangle whole{area.x - corner.x, area.y + area.height + corner.y - times * area.height,
                               times * area.width, times * area.height};
    const auto blit = [&](const Target& from, int left, int right) {
        if (left >= right) return;
        const glm::ivec2 size = from.sizePixels();
        const bool isScaled = size != glm::ivec2(area.width, area.height) && !magnification.isOn();
        gpu::setScissor({area.x + left, area.y, right - left, area.height});
        // Only the visible texels: the whole image, magnified, may exceed the largest rectangle of a driver.
        const glm::dvec2 perTexel = glm::dvec2(whole.width, whole.height) / glm::dvec2(size);
        const glm::dvec2 low(area.x - whole.x, area.y - whole.y), high = low + glm::dvec2(area.width, area.height);
        const glm::ivec2 first = glm::clamp(glm::ivec2(glm::floor(low / perTexel)), glm::ivec2(0), size);
        const glm::ivec2 last = glm::clamp(glm::ivec2(glm::ceil(high / perTexel)), first, size);
        const glm::ivec2 begin = glm::round(glm::dvec2(first) * perTexel),
                         end = glm::round(glm::dvec2(last) * perTexel);
        gpu::blitToWindow(from.framebuffer(), {first.x, first.y, last.x - first.x, last.y - first.y},
                          {whole.x + begin.x, whole.y + begin.y, end.x - begin.x, end.y - begin.y}, isScaled);
    };
    if (compare == Compare::Split && isOfOneScene()) {
        const int middle = std::clamp(int(std::lround(divider * float(area.width))), 0, area.width);
        blit(pictures_[0].display(), 0, middle);
        blit(pictures_[1].display(), middle, area.width);
    } else if (compare == Compare::Difference && canDiffer() && difference_.image() != nullptr) {
        blit(*difference_.image(), 0, area.width);
    } else {
        blit(showsSmoothed() ? *smoothing_.shown() : pictures_[0].display(), 0, area.width);
    }
    gpu::bindWindowFramebuffer(windowPixels.x, windowPixels.y); // disables the scissor test
}

double Screen::meanLuminance() const {
    const DrawnPicture& shown = picture(0);
    if (!shown.isThere() || shown.radiance() == nullptr || !frame::showsLitPicture(shown.look().settings.view))
        return 0.0;
    const Picture radiance = engine::toPicture(engine::readBack(shown.radiance()->texture(), nullptr));
    double sum = 0.0;
    for (std::size_t i = 0; i < radiance.pixelCount(); ++i) {
        const float* const rgba = radiance.pixel(i);
        const double luminance = 0.2126 * double(rgba[0]) + 0.7152 * double(rgba[1]) + 0.0722 * double(rgba[2]);
        if (std::isfinite(luminance)) sum += luminance;
    }
    return sum / double(std::max<std::size_t>(radiance.pixelCount(), 1));
}

void Screen::magnify(int side, const glm::vec2& place, const gpu::Rectangle& square) {
    const int times = std::min(square.width, square.height) / kLoupeTexels;
    if (!picture(side).isThere() || times < 1) return;
    const Target& from = picture(side).display();
    const glm::ivec2 size = from.sizePixels(), pixel = pixelAt(place, size);
    const glm::ivec2 first = glm::ivec2(pixel.x, size.y - 1 - pixel.y) - kLoupeTexels / 2; // from the lower left
    const glm::ivec2 begin = glm::max(first, glm::ivec2(0)), end = glm::min(first + kLoupeTexels, size);
    const glm::ivec2 corner = glm::ivec2(square.x, square.y) + times * (begin - first), shown = end - begin;
    gpu::setScissor(square);
    gpu::clearColor(0, kBehindPicture);
    gpu::blitToWindow(from.framebuffer(), {begin.x, begin.y, shown.x, shown.y},
                      {corner.x, corner.y, times * shown.x, times * shown.y}, false);
}

} // namespace tessera::viewer
