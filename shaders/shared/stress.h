#pragma once
// What the shaders of the stability suite (shaders/stress) share with the program that runs them.
#include "interop.h"

// Invocations of a group.
#define STRESS_GROUP 64

// Storage blocks; nothing else that these shaders bind is a storage block.
#define STORAGE_STRESS_INPUTS 0
#define STORAGE_STRESS_OUTPUTS 1
