#include "simrobot/setup/urdf_source.h"

#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <sstream>

namespace sim
{
namespace
{

/* Takes what urdfdom would write on stderr, as long as it lives. */
class Listener : public console_bridge::OutputHandler
{
public:
    Listener(std::string path, Findings *findings) : path_(std::move(path)), findings_(findings)
    {
        console_bridge::useOutputHandler(this);
    }

    ~Listener() override
    {
        console_bridge::restorePreviousOutputHandler();
    }

    void log(const std::string &text, console_bridge::LogLevel level, const char *, int) override
    {
        std::string line = path_ + ": " + text;
        std::replace(line.begin(), line.end(), '\n', ' ');
        if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR)
            findings_->faults.push_back(line);
        else if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN)
            findings_->notes.push_back(line);
    }

private:
    std::string path_;
    Findings *findings_;
};

bool ends_with(const std::string &text, const std::string &end)
{
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<double> numbers_in(const char *text)
{
    std::istringstream words(text);
    std::vector<double> numbers;

    words.imbue(std::locale::classic());
    for (double number; words >> number;)
        numbers.push_back(number);
    return numbers;
}

std::string text_of(const Eigen::Vector3d &v)
{
    std::ostringstream text;
    text.precision(17);
    text << v.x() << " " << v.y() << " " << v.z();
    return text.str();
}

} // namespace

/* Walks over the file's elements, notes where they are, and writes what urdfdom reads wrongly as it
 * reads it rightly. */
class UrdfNormaliser
{
public:
    UrdfNormaliser(UrdfSource *source, const std::set<std::string> &moving)
        : source_(source), moving_(moving)
    {
    }

    /* returns false for what is no URDF yet */
    bool robot(TiXmlElement *root)
    {
        for (TiXmlElement *part = root->FirstChildElement(); part;
             part = part->NextSiblingElement()) {
            std::string kind = part->Value();
            const char *name = part->Attribute("name");
            owner_ = kind + " " + (name ? name : "");
            if (kind == "link" || kind == "joint")
                source_->lines_[owner_] = part->Row();
            if (kind.compare(0, 6, "xacro:") == 0)
                xacro_ = true;
            walk(part);
            if (kind == "joint" && name)
                joint(part, name);
        }
        if (xacro_)
            source_->findings_->faults.push_back(
                source_->path_ + ": holds xacro: elements; make a URDF of it with: xacro " +
                source_->path_ + " > robot.urdf");
        return !xacro_;
    }

private:
    void walk(TiXmlElement *element)
    {
        std::string kind = element->Value();

        for (TiXmlAttribute *attribute = element->FirstAttribute(); attribute;
             attribute = attribute->Next()) {
            std::string text = attribute->Value();
            std::replace_if(
                text.begin(), text.end(),
                [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
            if (text != attribute->Value())
                attribute->SetValue(text);
        }
        if (kind == "color")
            colour(element);
        if (kind == "origin")
            origin(element);
        for (TiXmlElement *child = element->FirstChildElement(); child;
             child = child->NextSiblingElement())
            walk(child);
    }

    void note(const TiXmlElement *element, const std::string &what)
    {
        source_->findings_->notes.push_back(source_->path_ + ":" + std::to_string(element->Row()) +
                                            ": " + owner_ + ": " + what);
    }

    /* urdfdom draws a colour of three numbers black. */
    void colour(TiXmlElement *element)
    {
        const char *rgba = element->Attribute("rgba");

        if (!rgba || numbers_in(rgba).size() != 3)
            return;
        note(element, "rgba has three numbers; taken as opaque");
        element->SetAttribute("rgba", std::string(rgba) + " 1");
    }

    /* urdfdom takes a turn that is given as a quaternion for none. */
    void origin(TiXmlElement *element)
    {
        const char *text = element->Attribute("quat_xyzw");
        std::vector<double> q = numbers_in(text ? text : "");

        if (!text)
            return;
        if (q.size() != 4 || element->Attribute("rpy")) {
            source_->findings_->faults.push_back(
                source_->path_ + ":" + std::to_string(element->Row()) + ": " + owner_ +
                ": quat_xyzw wants four numbers, and no rpy beside it");
            return;
        }
        Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
        Eigen::Vector3d ypr = turn.normalized().toRotationMatrix().eulerAngles(2, 1, 0);
        note(element, "quat_xyzw is read, which other programs ignore");
        element->SetAttribute("rpy", text_of({ypr[2], ypr[1], ypr[0]}));
    }

    void joint(TiXmlElement *element, const std::string &name)
    {
        const TiXmlElement *limit = element->FirstChildElement("limit");
        const char *type = element->Attribute("type");

        for (const char *end : {"lower", "upper"})
            if (limit && limit->Attribute(end))
                source_->limits_.insert(name + " " + end);
        if (!type || std::string(type) == "fixed" || moving_.count(name))
            return;
        if (element->FirstChildElement("mimic")) {
            if (!limit) /* without which urdfdom takes the whole robot for wrong */
                element->InsertEndChild(no_limit());
            return;
        }
        element->SetAttribute("type", "fixed");
        for (const char *part : {"limit", "dynamics", "safety_controller", "calibration", "axis"})
            while (TiXmlElement *child = element->FirstChildElement(part))
                element->RemoveChild(child);
    }

    static TiXmlElement no_limit()
    {
        TiXmlElement limit("limit");
        for (const char *attribute : {"lower", "upper", "effort", "velocity"})
            limit.SetAttribute(attribute, "0");
        return limit;
    }

    UrdfSource *source_;
    const std::set<std::string> &moving_;
    std::string owner_; /* the link or joint in which the walk is */
    bool xacro_ = false;
};

UrdfSource::UrdfSource(std::string path, Findings *findings)
    : path_(std::move(path)), findings_(findings)
{
}

std::string UrdfSource::place(const char *kind, const std::string &name) const
{
    std::string owner = std::string(kind) + " " + name;
    auto line = lines_.find(owner);

    return path_ + (line == lines_.end() ? "" : ":" + std::to_string(line->second)) + ": " + owner +
           ": ";
}

void UrdfSource::fault(const char *kind, const std::string &name, const std::string &what)
{
    findings_->faults.push_back(place(kind, name) + what);
}

void UrdfSource::note(const char *kind, const std::string &name, const std::string &what)
{
    findings_->notes.push_back(place(kind, name) + what);
}

bool UrdfSource::has_limit(const std::string &joint, const char *attribute) const
{
    return limits_.count(joint + " " + attribute) > 0;
}

bool UrdfSource::read(std::string *text)
{
    std::ifstream file(path_);
    std::stringstream buffer;

    if (ends_with(path_, ".xacro")) {
        findings_->faults.push_back(path_ + ": is xacro, from which a URDF is made: xacro " +
                                    path_ + " > robot.urdf");
        return false;
    }
    if (!file || !(buffer << file.rdbuf())) {
        findings_->faults.push_back(path_ + ": cannot be read");
        return false;
    }
    *text = buffer.str();
    return true;
}

urdf::ModelInterfaceSharedPtr UrdfSource::parse(const std::string &text)
{
    Listener listener(path_, findings_);
    size_t before = findings_->faults.size();
    urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);

    if (model && model->getRoot())
        return model;
    if (findings_->faults.size() == before)
        findings_->faults.push_back(path_ + ": not a URDF robot");
    return nullptr;
}

urdf::ModelInterfaceSharedPtr UrdfSource::load(const std::set<std::string> &moving)
{
    std::string text;
    TiXmlDocument document;
    TiXmlPrinter printer;

    if (!read(&text))
        return nullptr;
    document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
    TiXmlElement *root = document.RootElement();
    if (document.Error() || !root) {
        findings_->faults.push_back(
            path_ + (document.Error() ? ":" + std::to_string(document.ErrorRow()) : "") +
            ": not a URDF robot: " + (document.Error() ? document.ErrorDesc() : "it is empty"));
        return nullptr;
    }
    if (!UrdfNormaliser(this, moving).robot(root))
        return nullptr;
    document.Accept(&printer);
    return parse(printer.CStr());
}

} // namespace sim
