#pragma once
// Constants shared by the shaders of the stability suite (shaders/stress) and the program that runs them.
#include "interop.h"

// Workgroup size.
#define STRESS_GROUP 64

// Storage blocks; these shaders bind no other storage block.
#define STORAGE_STRESS_INPUTS 0
#define STORAGE_STRESS_OUTPUTS 1
