// Fragment entry of lib/list_scan.glsl.
#define LIST_IN_COMPUTE 0
#include "lib/list_scan.glsl"

void main()
{
    scanTiles(listItem());
}
