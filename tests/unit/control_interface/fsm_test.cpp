#include "common/control_interface/behavior/fsm.h"

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

class Door : public FSM<std::string>
{
public:
  static constexpr unsigned int OPEN = 0;
  static constexpr unsigned int CLOSED = 1;
  static constexpr unsigned int LOCKED = 2;

  Door()
  {
    open_ = initializeState(this, OPEN, "[OPEN]");
    closed_ = initializeState(this, CLOSED, "[CLOSED]");
    locked_ = initializeState(this, LOCKED, "[LOCKED]");
    open_->addTransition("push", closed_);
    closed_->addTransition("pull", open_);
    closed_->addTransition("turn key", locked_);
    locked_->addTransition("turn key", closed_);
    setStartState(open_);
  }

  bool Do(const std::string& what) { return input(what); }
  void AddAgain() { open_->addTransition("push", closed_); }
  void AddTwice() { open_->addTransition("push", locked_); }
  void AddIdTwice() { initializeState(this, OPEN, "[AGAIN]"); }
  State<std::string>* open_;
  State<std::string>* closed_;
  State<std::string>* locked_;
};

class Unstarted : public FSM<int>
{
public:
  void Do() { input(1); }
};

TEST(Fsm, InputsTakeTheTransitionsOfTheCurrentState)
{
  Door door;
  EXPECT_EQ(door.GetStateID(), Door::OPEN);
  EXPECT_TRUE(door.Do("push"));
  EXPECT_EQ(door.GetStateName(), "[CLOSED]");
  EXPECT_TRUE(door.Do("turn key"));
  EXPECT_TRUE(door.Do("turn key"));
  EXPECT_TRUE(door.Do("pull"));
  EXPECT_EQ(door.GetStateID(), Door::OPEN);
}

TEST(Fsm, InputsWithoutATransitionLeaveTheStateAsItIs)
{
  Door door;
  EXPECT_FALSE(door.Do("turn key"));
  EXPECT_FALSE(door.Do(""));
  EXPECT_EQ(door.GetStateID(), Door::OPEN);
}

TEST(Fsm, MistakesInTheMachineAreReported)
{
  Door door;
  Door other;
  EXPECT_NO_THROW(door.AddAgain());
  EXPECT_THROW(door.AddTwice(), std::logic_error);
  EXPECT_THROW(door.AddIdTwice(), std::logic_error);
  EXPECT_THROW(door.open_->addTransition("fly", other.closed_), std::logic_error);
  Unstarted unstarted;
  EXPECT_THROW(unstarted.Do(), std::logic_error);
  EXPECT_THROW(unstarted.GetStateID(), std::logic_error);
}

TEST(Fsm, ASavedStateCanBeTakenUpAgain)
{
  Door door;
  door.RestoreState(Door::LOCKED);
  EXPECT_TRUE(door.Do("turn key"));
  EXPECT_EQ(door.GetStateID(), Door::CLOSED);
  EXPECT_THROW(door.RestoreState(99), std::out_of_range);
}

}  // namespace
}  // namespace swarmanoid
