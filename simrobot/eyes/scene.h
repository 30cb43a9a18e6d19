/* The room that the robot looks into: a wooden table, a papered wall, things on the table, among
 * them a plant that is greenish but is not the ball. Base frame; the base is at shoulder height. */
#ifndef SIMROBOT_EYES_SCENE_H
#define SIMROBOT_EYES_SCENE_H

#include "simrobot/eyes/mesh.h"

namespace sim
{

/* Square textures of three bytes a pixel, side `size`, that repeat without a seam. */
std::vector<uint8_t> scene_wood(int size);
std::vector<uint8_t> scene_wallpaper(int size);

/* What carries a texture. */
Corners scene_table();
Corners scene_walls();

/* What does not: books, a mug, a plant in a pot, a poster. */
Corners scene_things();

} // namespace sim
#endif
