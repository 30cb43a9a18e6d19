#include "simrobot/eyes/egl_context.h"

#include <EGL/eglext.h>
#include <GLES3/gl3.h>

#include <cstring>

namespace sim
{
namespace
{

const char advice[] = "; install Mesa's EGL and drivers (Debian: libegl1 libgl1-mesa-dri) or run "
                      "with --no-eyes";

bool has_word(const char *list, const char *word)
{
    return list && strstr(list, word);
}

} // namespace

/* Surfaceless is Mesa's; where it is missing (other drivers), the default display may do. */
bool EglContext::open_display()
{
    const char *extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);

    if (has_word(extensions, "EGL_MESA_platform_surfaceless"))
        display_ =
            eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ != EGL_NO_DISPLAY && eglInitialize(display_, nullptr, nullptr))
        return true;
    display_ = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display_ != EGL_NO_DISPLAY && eglInitialize(display_, nullptr, nullptr))
        return true;
    display_ = EGL_NO_DISPLAY;
    return false;
}

bool EglContext::make_current()
{
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_ES3_BIT, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;

    if (!eglBindAPI(EGL_OPENGL_ES_API) || !eglChooseConfig(display_, wanted, &config, 1, &count) ||
        count < 1)
        return false;
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
    return context_ != EGL_NO_CONTEXT &&
           eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

std::unique_ptr<EglContext> EglContext::create(std::string *error)
{
    std::unique_ptr<EglContext> context(new EglContext);

    if (!context->open_display()) {
        *error = std::string("eyes: EGL finds no display") + advice;
        return nullptr;
    }
    if (!context->make_current()) {
        *error = std::string("eyes: EGL has no OpenGL ES 3 without a window") + advice;
        return nullptr;
    }
    return context;
}

EglContext::~EglContext()
{
    if (display_ == EGL_NO_DISPLAY)
        return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT)
        eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

std::string EglContext::renderer() const
{
    const GLubyte *name = glGetString(GL_RENDERER);
    return name ? reinterpret_cast<const char *>(name) : "unknown";
}

} // namespace sim
