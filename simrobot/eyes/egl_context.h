/* An OpenGL ES 3 context without a window, through EGL; it works without a GPU and a display. */
#ifndef SIMROBOT_EYES_EGL_CONTEXT_H
#define SIMROBOT_EYES_EGL_CONTEXT_H

#include <EGL/egl.h>

#include <memory>
#include <string>

namespace sim
{

class EglContext
{
public:
    /* Makes a context and makes it current in the calling thread, which alone may draw.
     *   returns nullptr with one line in `error` that says what to install. */
    static std::unique_ptr<EglContext> create(std::string *error);
    ~EglContext();
    EglContext(const EglContext &) = delete;
    EglContext &operator=(const EglContext &) = delete;

    /* Name of what draws, such as "llvmpipe (LLVM 15.0.6, 256 bits)". */
    std::string renderer() const;

private:
    EglContext() = default;

    bool open_display();
    bool make_current();

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace sim
#endif
