// Records of a stability test: numbers in, numbers out, one invocation per record.
#pragma once
#include "shared/stress.h"

layout(local_size_x = STRESS_GROUP) in;
layout(std430, binding = STORAGE_STRESS_INPUTS) readonly buffer StressInputs { vec4 inputs[]; };
layout(std430, binding = STORAGE_STRESS_OUTPUTS) writeonly buffer StressOutputs { vec4 outputs[]; };

// The invocation's record, or -1 for those beyond the last one.
int recordIndex(int inputsPerRecord)
{
    int index = int(gl_GlobalInvocationID.x);
    return index * inputsPerRecord < inputs.length() ? index : -1;
}
