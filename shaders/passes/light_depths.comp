// Compute entry of lib/list_depths.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/list_depths.glsl"

void main()
{
    findDepths(listItem());
}
