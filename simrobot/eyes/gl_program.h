/* Compiling shaders and making textures, with errors as text. */
#ifndef SIMROBOT_EYES_GL_PROGRAM_H
#define SIMROBOT_EYES_GL_PROGRAM_H

#include <GLES3/gl3.h>

#include <string>
#include <vector>

namespace sim
{

/*   returns the program, or 0 with the compiler's words in `error`. */
GLuint gl_program(const char *vertex_text, const char *fragment_text, std::string *error);

/* A square texture that repeats, of three bytes a pixel. */
GLuint gl_texture(const std::vector<uint8_t> &pixels, int size);

} // namespace sim
#endif
