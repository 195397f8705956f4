// Fragment entry of lib/list_reach.glsl.
#define LIST_IN_COMPUTE 0
#include "lib/list_reach.glsl"

void main()
{
    findReach(listItem());
}
