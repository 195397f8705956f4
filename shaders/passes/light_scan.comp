// Compute entry of lib/list_scan.glsl.
#define LIST_IN_COMPUTE 1
#include "lib/list_scan.glsl"

void main()
{
    scanTiles(listItem());
}
