// Fragment entry of lib/lists/list_reach.glsl.
#define LIST_IN_COMPUTE 0
#include "lib/lists/list_reach.glsl"

void main()
{
    findReach(listItem());
}
