// Cannot be loaded: the function is nowhere.
void FunctionThatNobodyDefines();

void Call() { FunctionThatNobodyDefines(); }
