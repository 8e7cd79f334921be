// Converts the code of users in a file of ARGoS3: controllers and loop functions.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "argos3/converter/convert_arena.h"
#include "argos3/converter/device_names.h"
#include "argos3/converter/node_reader.h"

namespace swarmanoid::argos3
{

class CodeConverter : NodeReader
{
public:
  // The references must outlive the object. `folder`: the file's folder. `media`: their types and ids.
  CodeConverter(const ConfigurationNode& root, const std::string& folder, ArenaConverter& arena,
                ConvertedExperiment& result, std::set<std::pair<std::string, std::string>> media)
      : NodeReader(result), root_(root), folder_(folder), arena_(arena), media_(std::move(media))
  {
  }

  void ConvertControllers(ConfigurationNode& ours);
  // Call it after the controllers. Returns whether loop functions make boxes or cylinders.
  bool MakesBodies() const { return makes_bodies_; }
  // Returns <user_functions> of <qt-opengl>; nullptr: there are none.
  const ConfigurationNode* UserFunctions() const;
  // Call it after the controllers and the arena.
  void ConvertLoopFunctions(ConfigurationNode& ours, bool for_rehearsal);

private:
  // `id`: of the controller in ARGoS3.
  void ConvertController(const ConfigurationNode& theirs, const std::string& id, const ArenaConverter::Variant& variant,
                         ConfigurationNode& parent);
  void NoteListsOf(const ConfigurationNode& controller);
  // Returns the id of the medium that a controller's range and bearing, or communication of Kilobots, names; nullopt
  // without the sensor.
  static std::optional<std::string> RadioMediumOf(const ConfigurationNode& controller);
  // Robots hear messages of their medium and their size only.
  void FindRadioChannels(const ConfigurationNode& controllers);
  // Copies the attributes of a Kilobot's medium to the options of a controller.
  void SetKilobotMedium(const std::string& medium, ConfigurationNode& options);
  // Replaces the program of a Kilobot's behaviour by its path.
  void FindBehavior(const ConfigurationNode& theirs, ConfigurationNode& params);
  // Returns whether the medium of range and bearing lets bodies hide senders.
  bool ChecksOcclusions(const std::string& medium) const;
  // Returns the attribute of the first of these sensors of the controller that has it; empty: none has.
  static std::string NoiseOf(const ConfigurationNode& controller, std::initializer_list<const char*> sensors,
                             const char* attribute);
  // Finds what the loop functions make, and whether they read the experiment file, by the names of constructors and
  // functions in the library.
  std::set<std::string> FindMadeKinds() const;
  // Keeps robots of the controller outside the arena, for loop functions that add some.
  void KeepSpare(const std::string& controller, const ConfigurationNode& theirs);
  // Converts the elements and returns their tags in ARGoS3, separated by blanks.
  template <class ConvertOne>
  std::string ConvertDevices(const ConfigurationNode& controller, const char* name, ConvertOne convert,
                             const DeviceContext& context, DeviceLists& lists)
  {
    const ConfigurationNode* theirs = FindChild(controller, name);
    std::string tags;
    if (theirs == nullptr) return tags;
    for (const auto& device : theirs->children)
    {
      if (FindAttributeOf(*device, "library") != nullptr || LibraryOfDevice(controller, name, *device)) continue;
      convert(*device, context, lists);
      tags += (tags.empty() ? "" : " ") + device->name;
    }
    return tags;
  }
  // Devices that name a library are ours, for scripts: they are taken as they are. Their tags, with blanks between
  // them.
  std::string TakeOwn(const ConfigurationNode& controller, const char* name, Devices& devices);
  // Returns the library that registers a device by REGISTER_SENSOR or REGISTER_ACTUATOR; nullopt: none does. `list`:
  // "sensors" or "actuators".
  std::optional<std::string> LibraryOfDevice(const ConfigurationNode& controller, const std::string& list,
                                             const ConfigurationNode& device);
  // Copies the devices that libraries register, with their libraries.
  void CopyRegistered(const ConfigurationNode& controller, const std::string& list, ConfigurationNode& parameters);
  static void MoveLength(ConfigurationNode& ours, ConfigurationNode& functions);
  // Returns the folders in which libraries are searched.
  std::vector<std::filesystem::path> Folders() const;
  // `params`: those of the robots or the controller, or nullptr.
  void SetScript(const ConfigurationNode& theirs, const ConfigurationNode* params, ConfigurationNode& options);
  // Sets the library. `label`: the registered label. ARGoS3 loads all libraries of ARGOS_PLUGIN_PATH, so files need not
  // name one.
  void SetLibrary(const ConfigurationNode& theirs, const std::string& label, const char* ours,
                  ConfigurationNode& options);
  // Returns the library of Qt user functions; nullopt: it is not found.
  std::optional<std::string> UserLibrary(const ConfigurationNode& theirs) const;
  // Returns false if they are left out.
  bool SetUserFunctions(const ConfigurationNode& theirs, ConfigurationNode& functions);
  static std::optional<std::string> LibraryThatNames(const std::string& label, std::string& searched);
  // Returns the first file with one of the names in one of the folders. Otherwise the tried paths are added, a line
  // each.
  static std::optional<std::string> Found(const std::vector<std::filesystem::path>& folders,
                                          const std::vector<std::string>& names, std::string& searched);

  const ConfigurationNode& root_;
  const std::string& folder_;
  ArenaConverter& arena_;
  std::vector<Made> options_;                                   // by controller
  std::set<std::pair<std::string, long long>> radio_channels_;  // media and sizes of messages
  std::set<std::pair<std::string, std::string>> media_;         // types and ids
  std::set<std::string> made_kinds_;
  bool makes_bodies_ = false;
  bool resets_runs_ = false;
  bool asks_for_configuration_ = false;
  bool has_registered_devices_ = false;
  std::map<std::string, std::optional<std::string>> libraries_of_devices_;  // by the label in the library
  std::string controller_libraries_;                                        // separated by colons
};

}  // namespace swarmanoid::argos3
