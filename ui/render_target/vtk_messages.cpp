#include "ui/render_target/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <stdexcept>

#include "ui/drawing/shader_file.hpp"

namespace nextview {

class VtkMessages::Collector : public vtkOutputWindow {
 public:
  static Collector* New();
  vtkTypeMacro(Collector, vtkOutputWindow) void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    errors += text;
    if (is_shader_error(errors)) throw std::runtime_error(explain_drawing_error(errors));
  }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

  std::string errors;
};

vtkStandardNewMacro(VtkMessages::Collector);

VtkMessages::VtkMessages()
    : previous_(vtkOutputWindow::GetInstance()),
      collector_(vtkSmartPointer<Collector>::New()),
      previous_verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
  vtkOutputWindow::SetInstance(collector_);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkOutputWindow::SetInstance(previous_);
  vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(previous_verbosity_));
}

const std::string& VtkMessages::errors() const { return collector_->errors; }

}  // namespace nextview
