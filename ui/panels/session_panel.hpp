#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ui/panels/panel.hpp"
#include "ui/panels/panel_table.hpp"
#include "ui/panels/setting_control.hpp"

namespace nextview {

/// Every setting with its unit, help, default and a way back to it: the ones that people change most, then all of them
/// by group. A change starts the scan over.
class SessionPanel : public PanelContent {
 public:
  void draw(const PanelContext& context, const Rectangle& rectangle) override;

 private:
  void draw_setting(const PanelContext& context, Setting& setting, const char* name);
  void draw_object(const PanelContext& context, Setting& setting);
  const std::string& default_of(const std::string& key) const;
  void draw_sensor(const PanelContext& context, const Setting& setting);
  void draw_group(const PanelContext& context, const std::string& group);
  void take(const SessionSnapshot& snapshot);

  Configuration edited_;
  std::vector<Setting> settings_;  ///< of `edited_`
  TypedSetting typed_;
  const SessionSnapshot* seen_ = nullptr;        ///< that `edited_` was taken from
  std::map<std::string, std::string> defaults_;  ///< of each setting by its key, as text
};

}  // namespace nextview
