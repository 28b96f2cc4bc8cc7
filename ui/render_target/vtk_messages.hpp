#pragma once
#include <vtkSmartPointer.h>

#include <string>

class vtkOutputWindow;

namespace nextview {

/// Collects what VTK reports while this object lives, instead of letting VTK print it. Objects nest; the innermost
/// collects. If a shader does not compile, std::runtime_error is thrown through VTK at once: going on would crash it.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// Errors so far, empty if there were none. Warnings are not kept.
  const std::string& errors() const;

 private:
  class Collector;
  vtkSmartPointer<vtkOutputWindow> previous_;
  vtkSmartPointer<Collector> collector_;
  int previous_verbosity_;
};

}  // namespace nextview
