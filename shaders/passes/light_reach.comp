// Compute entry of lib/list_reach.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/list_reach.glsl"

void main()
{
    findReach(listItem());
}
