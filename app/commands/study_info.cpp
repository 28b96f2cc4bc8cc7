#include "app/commands/study_info.hpp"

#include <fmt/format.h>

#include "app/commands/shell_text.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"

namespace nextview {

std::string study_info(const std::filesystem::path& folder, const StudyContents& study) {
  std::string text = fmt::format("the study '{}' of {}", printable(study.name), counted(study.runs, "run"));
  text += study.has_summary
              ? fmt::format(", with its summary: nextview figure report --study {} --out DIR", shell_text(folder))
              : fmt::format(", {} of them done here; the command that began it goes on by --resume", study.done);
  for (const std::string& object : study.objects) text += "\n  " + printable(object);
  return text;
}

}  // namespace nextview
