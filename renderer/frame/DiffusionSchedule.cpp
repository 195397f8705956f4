#include "renderer/frame/DiffusionSchedule.h"

#include <utility>

namespace tessera::frame {

DiffusionSchedule::DiffusionSchedule(DiffusionMemory* memory, std::vector<Object> objects, bool holdsAtlas,
                                     std::function<void()> objectDiffused)
    : memory_(memory), objects_(std::move(objects)), holdsAtlas_(holdsAtlas),
      objectDiffused_(std::move(objectDiffused)) {
    if (memory_) memory_->begin(objects_.size(), holdsAtlas);
}

bool DiffusionSchedule::leaves(std::size_t cell) const {
    if (!memory_ || !memory_->isIdle(cell, objects_[cell].key, objects_[cell].seen)) return false;
    // An atlas must be written before it is read.
    return holdsAtlas_ || writes_ || cell + 1 < objects_.size();
}

DiffusionTask DiffusionSchedule::next(std::size_t cell, bool holdsLight) {
    writes_ = true;
    const Object& object = objects_[cell];
    DiffusionTask task;
    if (!memory_) {
        task.work.levels.resize(object.variancesSquareMetres.size());
        return task;
    }
    if (!holdsLight) memory_->forgetLit(cell);
    task.work = memory_->next(cell, object.key, *object.tiles, object.variancesSquareMetres, object.seen);
    task.diffuses = !memory_->isLimited() || !task.work.store.isEmpty();
    task.lights = !task.work.light.isEmpty() || (task.diffuses && !holdsLight);
    task.lit = [memory = memory_, cell, key = object.key, tiles = task.work.light] {
        memory->hold(cell, key, tiles, {});
    };
    task.stored = [memory = memory_, cell, key = object.key, tiles = task.work.store, report = objectDiffused_] {
        memory->hold(cell, key, {}, tiles);
        if (report) report();
    };
    task.blanked = [memory = memory_, cell, key = object.key, tiles = task.work.blank] {
        memory->holdBlank(cell, key, tiles);
    };
    return task;
}

} // namespace tessera::frame
