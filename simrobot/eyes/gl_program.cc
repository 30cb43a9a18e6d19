#include "simrobot/eyes/gl_program.h"

namespace sim
{
namespace
{

GLuint compile(GLenum kind, const char *text, std::string *error)
{
    GLuint shader = glCreateShader(kind);
    GLint good = 0;
    char log[512] = "";

    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good)
        return shader;
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    *error = std::string("eyes: the graphics driver refuses a shader: ") + log;
    glDeleteShader(shader);
    return 0;
}

} // namespace

GLuint gl_program(const char *vertex_text, const char *fragment_text, std::string *error)
{
    GLuint vertex = compile(GL_VERTEX_SHADER, vertex_text, error);
    GLuint fragment = vertex ? compile(GL_FRAGMENT_SHADER, fragment_text, error) : 0;
    GLuint program = 0;
    GLint good = 0;

    if (vertex && fragment) {
        program = glCreateProgram();
        glAttachShader(program, vertex);
        glAttachShader(program, fragment);
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &good);
        if (!good) {
            *error = "eyes: the graphics driver cannot link a shader program";
            glDeleteProgram(program);
            program = 0;
        }
    }
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    return program;
}

GLuint gl_texture(const std::vector<uint8_t> &pixels, int size)
{
    GLuint texture = 0;

    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, size, size, 0, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

} // namespace sim
